#include "wordgaze/io/stop_signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace wordgaze::io {
namespace {

TEST(StopSignals, AreAWishThatIsAnsweredAtOnce) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    testing::internal::CaptureStderr();
    const StopSignals signals("stopping soon\n");
    EXPECT_EQ(signals.received(), 0);
    EXPECT_NO_THROW(StopSignals::check());
    std::raise(signal);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "stopping soon\n");
    EXPECT_EQ(signals.received(), signal);
    try {
      StopSignals::check();
      ADD_FAILURE() << "nothing was thrown";
    } catch (const Stopped& stopped) {
      EXPECT_EQ(stopped.exit_code(), 128 + signal);
    }
  }
}

TEST(StopSignals, TheSecondEndsTheProgram) {
  for (const int first : {SIGINT, SIGTERM, SIGHUP}) {
    for (const int second : {SIGINT, SIGTERM}) {
      EXPECT_EXIT(
          {
            const StopSignals signals("");
            std::raise(first);
            std::raise(second);
            std::_Exit(0);
          },
          testing::KilledBySignal(second), "");
    }
  }
}

TEST(StopSignals, ATerminalThatClosesMayHangUpTwice) {
  EXPECT_EXIT(
      {
        const StopSignals signals("");
        std::raise(SIGHUP);
        std::raise(SIGHUP);
        std::_Exit(signals.received());
      },
      testing::ExitedWithCode(SIGHUP), "");
}

TEST(StopSignals, LeaveAnIgnoredHangUpIgnored) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        const StopSignals signals("");
        std::raise(SIGHUP);
        std::_Exit(signals.received());
      },
      testing::ExitedWithCode(0), "");
}

TEST(StopSignals, AreAsBeforeAfterwards) {
  EXPECT_EXIT(
      {
        { const StopSignals signals(""); }
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace wordgaze::io
