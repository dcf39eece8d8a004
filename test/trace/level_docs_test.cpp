#include "wordgaze/trace/level_docs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace wordgaze::trace {
namespace {

TEST(LevelDocs, AreUpToDate) {
  std::ifstream file(WORDGAZE_SOURCE_DIR "/docs/levels.md");
  std::stringstream kept, now;
  kept << file.rdbuf();
  write_level_docs(now);
  EXPECT_EQ(kept.str(), now.str()) << "renew it: wordgaze levels --page > docs/levels.md";
}

}  // namespace
}  // namespace wordgaze::trace
