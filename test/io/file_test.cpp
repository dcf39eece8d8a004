#include "wordgaze/io/file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t files_in(const TemporaryFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

TEST(File, ReadsTheBytesItWrote) {
  const TemporaryFolder folder;
  std::string bytes(200'000, 'x');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  const std::array<std::string_view, 3> parts{bytes, "", "end"};
  write_file(folder / "a", parts);
  EXPECT_EQ(read_file(folder / "a"), bytes + "end");
  write_file(folder / "a", "");
  EXPECT_EQ(read_file(folder / "a"), "");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(File, KeepsTheOldContentWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a";
  write_file(path, "old");
  const std::string large(100'000, 'x');
  const std::string message = message_of<std::runtime_error>([&] {
    const SmallDisk disk(10'000);
    write_file(path, large);
  });
  EXPECT_TRUE(contains(message, "cannot write '" + path.string() + "': File too large"));
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(File, SaysWhyItCannotReadOrWrite) {
  const TemporaryFolder folder;
  const auto reading = [&](const fs::path& path) {
    return message_of<std::runtime_error>([&] { read_file(path); });
  };
  const auto writing = [&](const fs::path& path) {
    return message_of<std::runtime_error>([&] { write_file(path, "x"); });
  };
  EXPECT_TRUE(contains(reading(folder / "none"), "none': No such file or directory"));
  EXPECT_TRUE(contains(reading(folder.path()), "Is a directory"));
  EXPECT_TRUE(contains(writing(folder / "no/file"), "no/file': No such file or directory"));
  EXPECT_TRUE(contains(writing(folder.path()), "Is a directory"));
}

TEST(File, WritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  write_file(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "new");
}

TEST(File, WritesIntoADeviceInsteadOfReplacingIt) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder / "sink");
  write_file(folder / "sink", "lost");
  EXPECT_TRUE(fs::is_character_file(folder / "sink"));
  EXPECT_EQ(files_in(folder), 1);
}

TEST(File, ReportsAFullDevice) {
  const std::string message =
      message_of<std::runtime_error>([] { write_file("/dev/full", "does not fit"); });
  EXPECT_EQ(message, "cannot write '/dev/full': No space left on device");
}

}  // namespace
}  // namespace wordgaze::io
