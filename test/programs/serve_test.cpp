#include <gtest/gtest.h>
#include <unistd.h>

#include <regex>
#include <string>

#include "programs/shell.hpp"
#include "support/messages.hpp"

/// The command serve, asked by programs of their own over a multicast group of this test.
namespace wordgaze {
namespace {

#if WORDGAZE_WITH_LCM
const std::string kModels = WORDGAZE_SOURCE_DIR "/models/";

struct Serve : ::testing::Test {
  Shell run;
  const std::string url =
      "udpm://239.255.76.69:" + std::to_string(20'000 + ::getpid() % 40'000) + "?ttl=0";

  /// Runs a command while `serve OPTIONS` listens, which a signal ends then.
  Shell::Result serve(const std::string& options, const std::string& command,
                      const std::string& signal = "INT") const {
    return run("url='" + url + "'\nwordgaze serve --lcm-url $url " + options +
               " >serve.txt 2>serve.err & server=$!\n"
               "until grep -q 'listens on' serve.txt\n"
               "do kill -0 $server || exit 99; sleep 0.02; done\n" +
               command + "\nstatus=$?\nkill -" + signal +
               " $server; wait $server; echo $? >ended.txt; exit $status");
  }
  bool has_no_route() const {
    return run.read("serve.err").find("ip route add") != std::string::npos;
  }
};

#define SKIP_WITHOUT_ROUTE() \
  if (has_no_route()) GTEST_SKIP() << "needs a route for multicast"

TEST_F(Serve, LetsARobotActAndSaysWhatItDid) {
  const auto robot = serve("--checkpoint " + kModels + "single-attention.safetensors --greedy",
                           "example_robot $url");
  SKIP_WITHOUT_ROUTE();
  ASSERT_TRUE(succeeded(robot));
  EXPECT_TRUE(contains(robot.out, "ball 0 right, 1 ahead: done"));
  const std::string said = run.read("serve.txt");
  EXPECT_TRUE(contains(said, "listens on " + url + ", WORDGAZE_POLICY_REQUEST"));
  EXPECT_TRUE(contains(said, "likeliest actions"));
  EXPECT_TRUE(
      contains(said, " 0 errors, 1 clients, 0 evictions, 0 messages that were no requests"));
  EXPECT_EQ(run.read("ended.txt"), "130\n");
  EXPECT_TRUE(contains(run.read("serve.err"), "serve: stopping"));
}

TEST_F(Serve, AnswersARobotThatAsksForWhatIsUnknown) {
  const auto robot = serve("--checkpoint " + kModels + "single-attention.safetensors",
                           "example_robot $url 'go to the moon'", "TERM");
  SKIP_WITHOUT_ROUTE();
  EXPECT_EQ(robot.status, 1);
  EXPECT_TRUE(contains(robot.out, "not in the vocabulary: 'moon'"));
  EXPECT_TRUE(contains(run.read("serve.txt"), "drawn actions, seed 1"));
  EXPECT_TRUE(
      contains(run.read("serve.txt"), "serve: 1 requests (0 repeats), 1 errors, 0 clients"));
  EXPECT_EQ(run.read("ended.txt"), "143\n");
}

TEST_F(Serve, KnowsTheCellsOfTheLevelThatItWasTrainedInOrOfAnother) {
  for (const bool doors : {false, true}) {
    const auto soak = serve("--checkpoint " + kModels + "single-attention.safetensors" +
                                (doors ? " --env BabyAI-GoToObjMaze-v0" : ""),
                            "policy_soak --lcm-url $url --checkpoint " + kModels +
                                "single-attention.safetensors --env BabyAI-GoToObjMaze-v0 "
                                "--requests 500 --robots 2");
    SKIP_WITHOUT_ROUTE();
    EXPECT_EQ(soak.status, doors ? 0 : 1) << describe(soak);
  }
}

TEST_F(Serve, LetsARobotInPythonAct) {
  if (run("python3 -c 'import lcm'").status != 0) GTEST_SKIP() << "needs the package lcm of Python";
  const auto robot = serve("--checkpoint " + kModels + "single-attention.safetensors --greedy",
                           "mkdir types && lcm-gen --python --ppath types " WORDGAZE_SOURCE_DIR
                           "/lcmtypes/policy_*.lcm && PYTHONPATH=types python3 " WORDGAZE_SOURCE_DIR
                           "/examples/robot.py $url");
  SKIP_WITHOUT_ROUTE();
  ASSERT_TRUE(succeeded(robot));
  EXPECT_TRUE(contains(robot.out, "ball 0 right, 1 ahead: done"));
}

// The same at length: scripts/soak.
TEST_F(Serve, IsRightForRobotsOverABadNetwork) {
  for (const std::string model : {"single-attention", "single-baseline", "structured"}) {
    const std::string checkpoint = "--checkpoint " + kModels + model + ".safetensors ";
    const std::string world =
        model == "structured" ? "--env Wordgaze-Two-N10-K4-v0 " : "--env Wordgaze-One-N8-K4-v0 ";
    const auto soak =
        serve(checkpoint + "--clients 7", "policy_soak --lcm-url $url " + world + checkpoint +
                                              "--requests 3000 --robots 8 --server $server");
    SKIP_WITHOUT_ROUTE();
    EXPECT_TRUE(succeeded(soak)) << model << soak.out;
    EXPECT_TRUE(contains(soak.out, "wrong 0")) << model;
    EXPECT_FALSE(contains(soak.out, "told to reset 0,")) << soak.out;
    // It acts as well as where it was trained.
    std::smatch success;
    ASSERT_TRUE(std::regex_search(soak.out, success, std::regex("success ([0-9.]+) %")));
    if (model != "single-baseline") {
      EXPECT_GE(std::stod(success[1]), 97) << soak.out;
    }
    EXPECT_TRUE(contains(run.read("serve.err"), "is passed over: not a valid policy_request_t"));
  }
}

TEST_F(Serve, IsRefusedWhatItCannotServe) {
  EXPECT_TRUE(refused(run("wordgaze serve --checkpoint nothing"), "nothing"));
  const std::string serve_model =
      "wordgaze serve --checkpoint " + kModels + "single-attention.safetensors ";
  EXPECT_TRUE(refused(run(serve_model + "--lcm-url memq://"), "expected udpm://"));
  EXPECT_TRUE(refused(run(serve_model + "--lcm-url ''"), "--lcm-url"));
  EXPECT_TRUE(refused(run(serve_model + "--clients 0"), "--clients", "1 to 100000"));
  EXPECT_TRUE(refused(run(serve_model + "--greedy --sample"), "--greedy"));
  EXPECT_TRUE(refused(run("wordgaze serve"), "--checkpoint"));
}

#else
TEST(Serve, SaysThatItWasBuiltWithoutLcm) {
  EXPECT_TRUE(refused(Shell()("wordgaze serve --checkpoint ckpt"), "without LCM"));
}
#endif

}  // namespace
}  // namespace wordgaze
