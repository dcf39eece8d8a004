#include "wordgaze/io/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace wordgaze::io {
namespace {

TEST(FolderLock, IsHeldByOneAtATime) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    const auto message =
        message_of<std::runtime_error>([&] { const FolderLock second(folder.path()); });
    EXPECT_TRUE(contains(message, folder.path().string()));
    EXPECT_TRUE(contains(message, "at work"));
  }
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

TEST(FolderLock, DiesWithItsProcess) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    if (::write(ready[1], "!", 1) == 1) ::pause();
    std::_Exit(1);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THROW(FolderLock(folder.path()), std::runtime_error);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

TEST(FolderLock, SaysWhereItCannotBe) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { FolderLock lock(folder / "none"); }), "none"));
}

}  // namespace
}  // namespace wordgaze::io
