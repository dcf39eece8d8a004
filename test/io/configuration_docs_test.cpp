#include <gtest/gtest.h>

#include <cstdlib>

#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/training/config.hpp"

namespace wordgaze::io {
namespace {

TEST(ConfigurationDocs, AreUpToDate) {
  const std::string path = WORDGAZE_SOURCE_DIR "/docs/configuration.md";
  const std::string heading = "## Settings\n\n";
  const std::string kept = read_file(path);
  const std::size_t end = kept.find(heading);
  ASSERT_NE(end, kept.npos);
  const std::string now = kept.substr(0, end) + heading + to_markdown<training::TrainConfig>();
  if (std::getenv("WORDGAZE_RENEW_DOCS") != nullptr) write_file(path, now);
  EXPECT_TRUE(read_file(path) == now)
      << "renew it: WORDGAZE_RENEW_DOCS=1 test_io --gtest_filter=ConfigurationDocs.*";
}

}  // namespace
}  // namespace wordgaze::io
