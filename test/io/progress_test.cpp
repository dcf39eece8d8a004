#include "wordgaze/io/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

TEST(DurationText, HasHoursOnlyWhenThereAreSome) {
  EXPECT_EQ(duration_text(0), "0:00");
  EXPECT_EQ(duration_text(59.6), "1:00");
  EXPECT_EQ(duration_text(3599), "59:59");
  EXPECT_EQ(duration_text(3723), "1:02:03");
}

/// Progress on a stream, with a clock that the test turns.
class ProgressLine : public ::testing::Test {
 protected:
  Progress::Options options(std::FILE* out) {
    return {.out = out, .terminal_interval_s = 1, .plain_interval_s = 10, .clock = [this] {
              return now_;
            }};
  }
  double now_ = 1000;
};

TEST_F(ProgressLine, IsDecorationThatMayBeLost) {
  const auto expect_no_harm = [&](std::FILE* out) {
    Progress progress("frames", 0, 100, options(out));
    for (const int done : {10, 20, 100}) {
      now_ += 20;
      EXPECT_NO_THROW(progress.update(done, "success 0.5"));
    }
  };
  std::FILE* full = std::fopen("/dev/full", "w");
  expect_no_harm(full);
  std::fclose(full);
  std::FILE* unwritable = std::fopen("/dev/zero", "r");
  expect_no_harm(unwritable);
  std::fclose(unwritable);
  const auto before = std::signal(SIGPIPE, SIG_IGN);  // as the program does
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  std::FILE* unread = ::fdopen(ends[1], "w");
  expect_no_harm(unread);
  std::fclose(unread);
  std::signal(SIGPIPE, before);
  int controller = 0, terminal = 0;
  ASSERT_EQ(::openpty(&controller, &terminal, nullptr, nullptr, nullptr), 0);
  std::FILE* closed = ::fdopen(terminal, "w");
  Progress progress("frames", 0, 100, options(closed));
  ::close(controller);
  now_ += 20;
  EXPECT_NO_THROW(progress.update(50, ""));
}

TEST_F(ProgressLine, IsPlainNowAndThenInAFile) {
  const TemporaryFolder folder;
  std::FILE* out = std::fopen((folder / "out").c_str(), "w");
  {
    Progress progress("frames", 0, 1000, options(out));
    const std::vector<std::pair<int, int>> updates{{1000, 0},   {1005, 50},  {1010, 100},
                                                   {1019, 190}, {1020, 200}, {1021, 1000}};
    for (const auto& [now, done] : updates) {
      now_ = now;
      progress.update(done, done > 100 ? "success 97 %" : "");
    }
  }
  std::fclose(out);
  EXPECT_EQ(read_file(folder / "out"),
            "frames 0 / 1000 (0 %)\n"
            "frames 100 / 1000 (10 %), 10 / s, 1:30 left\n"
            "frames 200 / 1000 (20 %), 10 / s, 1:20 left, success 97 %\n"
            "frames 1000 / 1000 (100 %), 48 / s, took 0:21, success 97 %\n");
}

TEST_F(ProgressLine, CountsTheRateFromWhereARunGoesOn) {
  const TemporaryFolder folder;
  std::FILE* out = std::fopen((folder / "out").c_str(), "w");
  Progress progress("frames", 500, 1000, options(out));
  now_ += 10;
  progress.update(600, "");
  std::fclose(out);
  EXPECT_EQ(read_file(folder / "out"), "frames 600 / 1000 (60 %), 10 / s, 0:40 left\n");
}

TEST_F(ProgressLine, IsRewrittenAndCutToTheWidthOfATerminal) {
  int master = -1, slave = -1;
  const winsize size{.ws_row = 24, .ws_col = 30, .ws_xpixel = 0, .ws_ypixel = 0};
  ASSERT_EQ(::openpty(&master, &slave, nullptr, nullptr, &size), 0);
  std::FILE* terminal = ::fdopen(slave, "w");
  {
    Progress progress("frames", 0, 100, options(terminal));
    progress.update(0, "");
    now_ += 0.5;
    progress.update(5, "");  // too early
    now_ += 0.5;
    progress.update(10, "success 97 %");
  }
  // A terminal hands on what it got in pieces.
  std::string shown;
  std::array<char, 256> buffer{};
  for (ssize_t count = 1; count > 0 && !shown.ends_with('\n');) {
    count = ::read(master, buffer.data(), buffer.size());
    shown.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  std::fclose(terminal);
  ::close(master);
  EXPECT_EQ(shown,
            "\rframes 0 / 100 (0 %)\033[K"
            "\rframes 10 / 100 (10 %), 10 / \033[K\r\n");
}

TEST_F(ProgressLine, WithoutAnEndHasTheRateOfNowAndIsSilentWhileIdle) {
  const TemporaryFolder folder;
  std::FILE* out = std::fopen((folder / "out").c_str(), "w");
  {
    Progress progress("requests", 0, 0, options(out));
    const std::vector<std::pair<int, int>> updates{
        {1000, 0}, {1003, 20}, {1010, 50}, {1020, 50}, {1030, 50}, {1040, 1050}, {1041, 1060}};
    for (const auto& [now, done] : updates) {
      now_ = now;
      progress.update(done, "no errors");
    }
  }
  std::fclose(out);
  EXPECT_EQ(read_file(folder / "out"),
            "requests 50, 5 / s, no errors\n"
            "requests 1050, 100 / s, no errors\n");
}

TEST(Progress, RefusesATotalBelowNothing) {
  EXPECT_THROW(Progress("frames", 0, -1), std::invalid_argument);
}

}  // namespace
}  // namespace wordgaze::io
