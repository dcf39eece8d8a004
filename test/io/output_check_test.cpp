#include "wordgaze/io/output_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

class OutputCheck : public testing::Test {
 protected:
  OutputCheck() {
    write_file(folder_ / "in", "input");
    fs::create_symlink("in", folder_ / "link");
    fs::create_symlink("link", folder_ / "far_link");
    fs::create_hard_link(folder_ / "in", folder_ / "hard");
    fs::create_symlink(".", folder_ / "here");
    fs::create_symlink("new", folder_ / "link_to_new");
  }
  void check(const fs::path& output, const fs::path& input, const fs::path& other = "") const {
    check_outputs(std::array{NamedPath{"--json", output}, NamedPath{"--log", other}},
                  std::array{NamedPath{"--checkpoint", input}});
  }
  TemporaryFolder folder_;
};

TEST_F(OutputCheck, RefusesWhatIsRead) {
  for (const std::string name : {"in", "link", "far_link", "hard", "here/in", "here/./in"}) {
    const auto message =
        message_of<std::invalid_argument>([&] { check(folder_ / name, folder_ / "in"); });
    EXPECT_TRUE(contains(message, "--json")) << name;
    EXPECT_TRUE(contains(message, "--checkpoint")) << name;
  }
  EXPECT_EQ(read_file(folder_ / "in"), "input");
}

TEST_F(OutputCheck, RefusesTwoOutputsInOneFile) {
  EXPECT_THROW(check(folder_ / "new", "", folder_ / "new"), std::invalid_argument);
  EXPECT_THROW(check(folder_ / "new", "", folder_ / "link_to_new"), std::invalid_argument);
  EXPECT_NO_THROW(check("/dev/null", "", "/dev/null"));
}

TEST_F(OutputCheck, RefusesPlacesThatCannotBeWritten) {
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { check(folder_ / "no/new", ""); }),
                       "No such file"));
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { check(folder_.path(), ""); }), "directory"));
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { check(folder_ / "in/new", ""); }),
                       "Not a directory"));
  EXPECT_THROW(check("/proc/new", ""), std::runtime_error);
}

TEST_F(OutputCheck, ChangesNothing) {
  const auto files = [&] {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  };
  const auto before = files();
  EXPECT_NO_THROW(check(folder_ / "new", folder_ / "in", folder_ / "other"));
  EXPECT_NO_THROW(check(folder_ / "link_to_new", folder_ / "in"));
  EXPECT_NO_THROW(check("", folder_ / "in"));
  EXPECT_NO_THROW(check("/dev/full", folder_ / "in"));
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace wordgaze::io
