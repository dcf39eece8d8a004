#include <gtest/gtest.h>

#include <algorithm>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"

/// The program as a whole: its commands, their names, how they fail.
namespace wordgaze {
namespace {

struct Program : ::testing::Test {
  Shell run;
  Program() { write_tiny_config(run); }
};

TEST_F(Program, ACommandIsTheSameByEitherName) {
  ASSERT_TRUE(succeeded(run("wordgaze train --config tiny.toml --out a")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out b")));
  const auto whole = run("wordgaze eval --checkpoint a/checkpoint.safetensors --episodes 5");
  const auto link = run("eval --checkpoint b/checkpoint.safetensors --episodes 5");
  ASSERT_TRUE(succeeded(whole));
  EXPECT_EQ(whole.out, link.out);
}

TEST_F(Program, SaysItsVersionAndHelpInOneWay) {
  const auto version = run("wordgaze --version");
  ASSERT_TRUE(succeeded(version));
  for (const std::string command : {"train", "eval", "trace", "bench"}) {
    EXPECT_EQ(run(command + " --version").out, version.out) << command;
    const auto help = run("wordgaze " + command + " --help");
    EXPECT_TRUE(succeeded(help)) << command;
    EXPECT_TRUE(contains(help.out, "--")) << command;
  }
  EXPECT_TRUE(contains(run("wordgaze --help").out, "levels"));
}

TEST_F(Program, HelpSaysDefaults) {
  for (const std::string eval : {"eval --help", "wordgaze eval --help"}) {
    EXPECT_TRUE(contains(run(eval).out, "=1000")) << eval;  // episodes
    EXPECT_FALSE(contains(run(eval).out, "=[]")) << eval;
  }
  EXPECT_TRUE(contains(run("bench --help").out, "=256"));
  EXPECT_TRUE(contains(run("wordgaze trace --help").out, "=0:4"));
}

TEST_F(Program, TakesNumbersWithAnExponent) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 1.28e2 --set seed=2e0")));
  EXPECT_TRUE(contains(run.read("a/config.toml"), "frames = 128"));
  EXPECT_TRUE(contains(run.read("a/config.toml"), "seed = 2"));
}

TEST_F(Program, SaysWhatMayHaveBeenMeant) {
  const std::string train = "train --config tiny.toml --out a ";
  for (const std::string program : {"", "wordgaze "}) {
    EXPECT_TRUE(refused(run(program + train + "--epochs 4"), "--epochs", "--set ppo.epochs"));
    EXPECT_TRUE(refused(run(program + train + "--epochs=4"), "--set ppo.epochs"));
    EXPECT_TRUE(refused(run(program + train + "--thread 1"), "--threads"));
    EXPECT_TRUE(refused(run(program + "eval --policy bot --episode 4"), "--episodes"));
  }
  const auto stranger = run(train + "--xyzzyplugh");
  EXPECT_EQ(stranger.status, 2);
  EXPECT_TRUE(refused(stranger, "--xyzzyplugh"));
  EXPECT_FALSE(contains(stranger.err, "did you mean"));
  EXPECT_EQ(run(train + "--epochs 4").status, 2);
}

TEST_F(Program, BadUseExitsWithTwoAndFailureWithOne) {
  for (const std::string bad :
       {"wordgaze", "wordgaze dance", "wordgaze train", "train --out a --frames",
        "train --config tiny.toml --out a --set ppo.clip=2000", "trace --replay t --env x",
        "eval --checkpoint a --policy bot", "eval --policy bot", "bench --sim no-such-level",
        "wordgaze levels NoSuchLevel"}) {
    const auto result = run(bad);
    EXPECT_EQ(result.status, 2) << bad << describe(result);
    EXPECT_FALSE(result.err.empty()) << bad;
  }
  for (const std::string failing :
       {"eval --checkpoint nothing", "train --config nothing.toml --out a"}) {
    const auto result = run(failing);
    EXPECT_EQ(result.status, 1) << failing << describe(result);
    EXPECT_TRUE(contains(result.err, "nothing")) << failing;
  }
}

TEST_F(Program, SaysThatStandardOutputIsFull) {
  for (const std::string command :
       {"wordgaze levels", "wordgaze --help", "wordgaze --version", "wordgaze train --help",
        "bench --sim BabyAI-GoToLocal-v0 --steps 100 --envs 2"}) {
    EXPECT_TRUE(refused(run(command + " >/dev/full"), "standard output", "No space left on device"))
        << command;
    EXPECT_TRUE(succeeded(run(command + " >&- 2>&- <&-"))) << command;
  }
}

TEST_F(Program, IsQuietWhereTheReaderHasSeenEnough) {
  const auto first = run("wordgaze levels | head -1; exit ${PIPESTATUS[1]}");
  EXPECT_TRUE(succeeded(first));
  EXPECT_EQ(first.err, "");
}

TEST_F(Program, StopsMeasuringForASignal) {
  for (const std::string what :
       {"--sim BabyAI-GoToLocal-v0", "--reset BabyAI-GoToLocal-v0", "--act tiny.toml"}) {
    const auto stopped =
        run("timeout --foreground --preserve-status --signal=INT 1 bench --seconds 3000 " + what);
    EXPECT_EQ(stopped.status, 130) << describe(stopped);
    EXPECT_TRUE(contains(stopped.err, "stopped by a signal"));
  }
}

TEST_F(Program, ListsItsLevels) {
  const auto ids = run("wordgaze levels --ids");
  ASSERT_TRUE(succeeded(ids));
  EXPECT_EQ(std::count(ids.out.begin(), ids.out.end(), '\n'), 172);
  const auto doors = run("wordgaze levels DoorKey");
  ASSERT_TRUE(succeeded(doors));
  EXPECT_TRUE(contains(doors.out, "MiniGrid-DoorKey-5x5-v0"));
  EXPECT_TRUE(contains(doors.out, "use the key to open the door and then get to the goal"));
  EXPECT_FALSE(contains(doors.out, "BabyAI-GoTo"));
}

TEST_F(Program, RecordsATrainedAgentAndReplaysIt) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  const std::string record =
      "trace --env Wordgaze-One-N8-K4-v0 --checkpoint a/checkpoint.safetensors --steps 40";
  ASSERT_TRUE(succeeded(run(record + " --out t.jsonl")));
  EXPECT_TRUE(contains(run.read("t.jsonl"), "agent, sampled"));
  const auto replayed = run("trace --replay t.jsonl");
  ASSERT_TRUE(succeeded(replayed));
  EXPECT_TRUE(contains(replayed.out, "steps 160 mismatches 0"));
  ASSERT_TRUE(succeeded(run(record + " --greedy --out g.jsonl")));
  EXPECT_NE(run.read("t.jsonl"), run.read("g.jsonl"));
}

TEST_F(Program, EvaluatesTheBot) {
  const auto bot = run("eval --policy bot --env BabyAI-GoToLocal-v0 --episodes 50 --json b.json");
  ASSERT_TRUE(succeeded(bot));
  EXPECT_TRUE(contains(bot.out, "100.0%"));
  EXPECT_TRUE(contains(run.read("b.json"), "\"policy\": \"bot\""));
}

TEST_F(Program, TrainsInLevelsWhoseNumberIsNotOneOfObjects) {
  for (const std::string id : {"MiniGrid-MultiRoom-N6-v0", "MiniGrid-LavaCrossingS9N1-v0"}) {
    EXPECT_TRUE(
        succeeded(run("train --config tiny.toml --out " + id + " --set probe_every=1 env=" + id)));
  }
}

}  // namespace
}  // namespace wordgaze
