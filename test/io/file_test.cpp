#include "wordgaze/io/file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

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

TEST(File, IsNotReadFromPipesAndDevices) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& path : {pipe, fs::path("/dev/zero"), fs::path("/dev/null")}) {
    const auto refusal = message_of<std::runtime_error>([&] { read_file(path); });
    EXPECT_TRUE(contains(refusal, "a pipe or a device; expected a regular file")) << path;
    EXPECT_THROW(expect_regular(path), std::runtime_error);
  }
}

TEST(File, TooLargeForTheMemoryIsSaidSo) {
  const TemporaryFolder folder;
  write_file(folder / "a", "x");
  fs::resize_file(folder / "a", std::uintmax_t{1} << 43);  // a hole: it takes no space
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { read_file(folder / "a"); }), "/a': "));
}

TEST(Text, IsReadFromFilesPipesAndDevices) {
  const TemporaryFolder folder;
  write_file(folder / "a", "text");
  EXPECT_EQ(read_text(folder / "a", 4), "text");
  EXPECT_EQ(read_text("/dev/null", 4), "");
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "through a pipe", 14), 14);
  ::close(ends[1]);
  EXPECT_EQ(read_text("/dev/fd/" + std::to_string(ends[0]), 100), "through a pipe");
  ::close(ends[0]);
}

TEST(Text, IsRefusedWhereItDoesNotEndOrDoesNotBegin) {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) {
    return message_of<std::runtime_error>([&] { read_text(path, 1000); });
  };
  EXPECT_TRUE(contains(refusal("/dev/zero"), "'/dev/zero': more than 1000 bytes"));
  EXPECT_TRUE(contains(refusal(folder.path()), "Is a directory"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(contains(refusal(folder / "pipe"), "a pipe into which nobody writes"));
}

fs::path temporary_of(const fs::path& path, pid_t process) {
  return path.string() + "." + std::to_string(process) + ".tmp";
}

TEST(File, IsNotWrittenThroughALinkInPlaceOfTheTemporaryFile) {
  const TemporaryFolder folder;
  write_file(folder / "precious", "kept");
  fs::create_symlink("precious", temporary_of(folder / "a", ::getpid()));
  write_file(folder / "a", "new");
  EXPECT_EQ(read_file(folder / "a"), "new");
  EXPECT_EQ(read_file(folder / "precious"), "kept");
  EXPECT_FALSE(fs::is_symlink(folder / "a"));
  EXPECT_EQ(files_in(folder), 2);
}

TEST(Temporaries, OfProcessesThatAreGoneAreCleared) {
  const TemporaryFolder folder;
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(gone, nullptr, 0), gone);
  const std::array left{temporary_of(folder / "a", gone), temporary_of(folder / "b", gone)};
  const std::array kept{folder / "a",  // first: writing it takes the name of this process
                        temporary_of(folder / "a", ::getpid()),
                        temporary_of(folder / "another", gone),
                        folder / "a.tmp",
                        folder / "a..tmp",
                        folder / "a.0.tmp",
                        folder / "a.-5.tmp",
                        folder / "a.12x.tmp",
                        folder / "a.99999999999999999999.tmp"};
  for (const fs::path& path : left) write_file(path, "left");
  for (const fs::path& path : kept) write_file(path, "kept");
  fs::create_directory(temporary_of(folder / "c", gone));
  clear_temporaries(folder.path(), {"a", "b", "c"});
  for (const fs::path& path : left) EXPECT_FALSE(fs::exists(path)) << path;
  for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::exists(temporary_of(folder / "c", gone)));
  EXPECT_NO_THROW(clear_temporaries(folder / "none", {"a"}));
}

}  // namespace
}  // namespace wordgaze::io
