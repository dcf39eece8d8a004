#include <gtest/gtest.h>

#include <string>

#include "programs/shell.hpp"
#include "support/messages.hpp"

/// wordgaze-spy, which is built where a JDK and LCM's jar are.
namespace wordgaze {
namespace {

struct Spy : ::testing::Test {
  Shell run;
  void SetUp() override {
    if (run("command -v wordgaze-spy").status != 0) GTEST_SKIP() << "built without a JDK";
  }
};

TEST_F(Spy, HasTheTypesAndADrawing) {
  const auto jar =
      run("jar tf \"$(dirname \"$(command -v wordgaze-spy)\")/../share/java/wordgaze.jar\"");
  ASSERT_TRUE(succeeded(jar));
  for (const std::string name : {"step_t", "episode_begin_t", "metrics_t", "policy_request_t",
                                 "policy_reply_t", "spy/GazePlugin"}) {
    EXPECT_TRUE(contains(jar.out, "wordgaze/" + name + ".class"));
  }
}

TEST_F(Spy, SaysWhatItLacks) {
  EXPECT_TRUE(contains(run("wordgaze-spy --help").out, "--lcm-url URL"));
  EXPECT_TRUE(refused(run("wordgaze-spy --lcm-url"), "expected --lcm-url URL"));
  EXPECT_TRUE(refused(run("wordgaze-spy -l udpm://"), "came '-l udpm://'"));
  EXPECT_TRUE(
      refused(run("unset DISPLAY; wordgaze-spy --lcm-url=udpm://"), "wordgaze-spy: there is no"));
}

}  // namespace
}  // namespace wordgaze
