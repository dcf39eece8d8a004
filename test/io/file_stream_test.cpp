#include "wordgaze/io/file_stream.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

auto files(const TemporaryFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

TEST(FileStream, TakesItsNameWhenItIsWhole) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  {
    FileStream file(folder / "a");
    file.stream() << "new";
    EXPECT_EQ(read_file(folder / "a"), "old");
    file.commit();
  }
  EXPECT_EQ(read_file(folder / "a"), "new");
  EXPECT_EQ(files(folder), 1);
}

TEST(FileStream, LeavesTheOldFileWhereItIsNot) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  { FileStream(folder / "a").stream() << "half"; }
  EXPECT_EQ(read_file(folder / "a"), "old");
  EXPECT_EQ(files(folder), 1);
}

TEST(FileStream, WritesThroughALink) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  fs::create_symlink("a", folder / "link");
  FileStream file(folder / "link");
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(read_file(folder / "a"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST(FileStream, SaysWhatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { FileStream(folder / "no/a"); }), "no/a"));
  write_file(folder / "a", "old");
  {
    const SmallDisk disk(1000);
    FileStream file(folder / "a");
    file.stream() << std::string(100'000, 'x');
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { file.check(); }), "too large"));
    EXPECT_THROW(file.commit(), std::runtime_error);
  }
  EXPECT_EQ(read_file(folder / "a"), "old");
  EXPECT_EQ(files(folder), 1);
  FileStream device("/dev/full");
  device.stream() << "lost";
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { device.commit(); }), "No space left"));
}

}  // namespace
}  // namespace wordgaze::io
