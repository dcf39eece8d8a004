#include "wordgaze/io/standard_streams.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace wordgaze::io {
namespace {

/// Each in a process of its own: the streams belong to all of it.
template <class Action>
void in_own_process(Action&& action) {
  EXPECT_EXIT(
      {
        action();
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

void demand(bool condition) {
  if (!condition) std::_Exit(9);
}

bool is_null_device(int descriptor) {
  struct stat is {
  }, null{};
  return ::fstat(descriptor, &is) == 0 && ::stat("/dev/null", &null) == 0 &&
         is.st_rdev == null.st_rdev;
}

TEST(StandardStreams, AreNeverAFileOfOurs) {
  for (const int closed : {0, 1, 2}) {
    in_own_process([&] {
      ::close(closed);
      secure_standard_streams();
      demand(is_null_device(closed));
      std::FILE* file = std::fopen("/dev/zero", "r");
      demand(::fileno(file) > 2);
    });
  }
  in_own_process([] {
    for (const int descriptor : {0, 1, 2}) ::close(descriptor);
    secure_standard_streams();
    for (const int descriptor : {0, 1, 2}) demand(is_null_device(descriptor));
  });
}

TEST(StandardStreams, ThatAreOpenStayAsTheyAre) {
  in_own_process([] {
    int ends[2];
    demand(::pipe(ends) == 0 && ::dup2(ends[1], 1) == 1);
    secure_standard_streams();
    print(stdout, "through");
    char text[8] = {};
    demand(::read(ends[0], text, 7) == 7 && std::string(text) == "through");
    demand(flush_standard_output());
  });
}

TEST(StandardStreams, AFullDiskIsNoticedAtTheEnd) {
  const auto notice = [](auto&& write) {
    in_own_process([&] {
      demand(std::freopen("/dev/full", "w", stdout) != nullptr);
      write();
      try {
        flush_standard_output();
        std::_Exit(8);
      } catch (const std::runtime_error& error) {
        demand(std::string(error.what()).find("No space left") != std::string::npos);
      }
    });
  };
  notice([] { print(stdout, "lost"); });
  notice([] { std::cout << "lost"; });
  notice([] { std::cout << "lost" << std::endl; });
  notice([] { std::fputs("lost", stdout); });
}

TEST(StandardStreams, APipeWithoutAReaderIsNoSignal) {
  in_own_process([] {
    int ends[2];
    demand(::pipe(ends) == 0 && ::dup2(ends[1], 1) == 1 && ::dup2(ends[1], 2) == 2);
    ::close(ends[0]);
    secure_standard_streams();
    print(stderr, "lost");
    print(stdout, "lost");
    demand(!flush_standard_output());
  });
}

}  // namespace
}  // namespace wordgaze::io
