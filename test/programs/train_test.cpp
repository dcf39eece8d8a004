#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"

namespace wordgaze {
namespace {

struct Train : ::testing::Test {
  Shell run;
  Train() { write_tiny_config(run); }
};

TEST_F(Train, LeavesConfigurationMetricsAndCheckpoint) {
  const Shell::Result trained = run("train --config tiny.toml --out a --seed 7 --set ppo.clip=0.3");
  ASSERT_TRUE(succeeded(trained));
  EXPECT_TRUE(contains(run.read("a/config.toml"), "seed = 7"));
  EXPECT_TRUE(contains(run.read("a/config.toml"), "clip = 0.3"));
  EXPECT_TRUE(contains(run.read("a/metrics.csv"), "success_rate"));
  EXPECT_TRUE(contains(trained.out, "a/checkpoint.safetensors"));
  EXPECT_TRUE(run.has("a/checkpoint.safetensors"));
}

TEST_F(Train, RepeatsARunBitForBit) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out b")));
  // Of the metrics, only the column of seconds may differ.
  EXPECT_TRUE(
      succeeded(run("diff <(cut -d, -f1,3- a/metrics.csv) <(cut -d, -f1,3- b/metrics.csv)")));
  EXPECT_GT(run.read("a/metrics.csv").size(), 100u);
}

TEST_F(Train, GoesOnFromItsCheckpoint) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out whole --frames 256")));
  // The learning rate falls over all frames, so half a run is a whole one that was interrupted.
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out half --frames 128")));
  const Shell::Result resumed = run("train --config tiny.toml --out half --frames 256 --resume");
  ASSERT_TRUE(succeeded(resumed));
  EXPECT_TRUE(succeeded(run("test $(wc -l <half/metrics.csv) = $(wc -l <whole/metrics.csv)")));
}

/// So many that only a signal ends the run.
const std::string kEndless = "train --config tiny.toml --frames 100000000";

TEST_F(Train, StopsForASignalAndSaysHowToGoOn) {
  const std::pair<std::string, int> signals[]{{"INT", 130}, {"TERM", 143}, {"HUP", 129}};
  for (const auto& [signal, status] : signals) {
    const Shell::Result stopped = run("timeout --foreground --preserve-status --signal=" + signal +
                                      " 1 " + kEndless + " --out " + signal);
    EXPECT_EQ(stopped.status, status) << describe(stopped);
    EXPECT_TRUE(contains(stopped.err, "again to stop at once"));
    EXPECT_TRUE(contains(stopped.err, "--resume"));
    // What the metrics tell of is in the checkpoint.
    const auto rows = run("tail -n +2 " + signal + "/metrics.csv | wc -l").out;
    const auto resumed = run("timeout --foreground --preserve-status --signal=INT 1 " + kEndless +
                             " --resume --out " + signal);
    EXPECT_EQ(resumed.status, 130) << describe(resumed);
    EXPECT_GT(std::stoi(run("tail -n +2 " + signal + "/metrics.csv | wc -l").out), std::stoi(rows));
    EXPECT_TRUE(succeeded(run("cut -d, -f1 " + signal + "/metrics.csv | tail -n +2 | sort -cnu")));
  }
}

TEST_F(Train, StopsAtOnceForASecondSignal) {
  // One update takes minutes.
  const auto stopped =
      run("train --config tiny.toml --out a --set ppo.steps=4096 ppo.epochs=100 & pid=$!\n"
          "until [ -e a/checkpoint.safetensors ]; do sleep 0.1; done; sleep 0.5\n"
          "kill -INT $pid; sleep 0.5; kill -0 $pid || exit 9\n"
          "kill -INT $pid; wait $pid");
  EXPECT_EQ(stopped.status, 130) << describe(stopped);
  EXPECT_TRUE(contains(stopped.err, "stopping after this update"));
  EXPECT_EQ(stopped.err.find("is saved in"), std::string::npos) << stopped.err;
  EXPECT_EQ(run("ls a | grep -c tmp").out, "0\n");
}

TEST_F(Train, OutlivesItsTerminalUnderNohup) {
  const auto stopped = run(
      "trap '' HUP; " + kEndless +
      " --out a & pid=$!\nuntil [ -e a/checkpoint.safetensors ]; do sleep 0.1; done; sleep 0.5\n"
      "kill -HUP $pid; sleep 0.5; kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.status, 143) << describe(stopped);
}

TEST_F(Train, NeedsNobodyWhoListens) {
  for (const std::string away :
       {"2>/dev/full", "2>&-", ">&-", "<&-", "<&- >&- 2>&-", "2> >(true)"}) {
    run("rm -rf a");
    ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a " + away))) << away;
    EXPECT_TRUE(run.has("a/checkpoint.safetensors")) << away;
    EXPECT_EQ(run("grep -vc '^[0-9nan.e+,-]*$' a/metrics.csv").out, "1\n") << away;  // the header
    EXPECT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 256 --resume"))) << away;
  }
}

TEST_F(Train, SaysThatItsResultCouldNotBeSaid) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a >/dev/full"), "standard output",
                      "No space left on device"));
  EXPECT_TRUE(run.has("a/checkpoint.safetensors"));
}

TEST_F(Train, HasAFolderOfItsOwn) {
  const auto second = run(
      kEndless + " --out a & pid=$!\nuntil [ -e a/checkpoint.safetensors ]; do sleep 0.1; done\n" +
      kEndless + " --out a; code=$?; " + kEndless +
      " --out a --resume && code=0\nkill -9 $pid; wait $pid; exit $code");
  EXPECT_TRUE(refused(second, "'a'", "at work"));
  // The lock died with its process.
  EXPECT_EQ(
      run("timeout --foreground --preserve-status --signal=INT 1 " + kEndless + " --out a --resume")
          .status,
      130);
}

TEST_F(Train, StartsASecondPhaseFromTheWeightsOfAFirst) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  EXPECT_TRUE(
      succeeded(run("train --config tiny.toml --out b --init a/checkpoint.safetensors "
                    "--set model.task_attention=true --set env=Wordgaze-Two-N8-K4-v0")));
  EXPECT_TRUE(
      succeeded(run("train --config tiny.toml --out c --init a/checkpoint.safetensors "
                    "--set model.completion_input=true --set env=Wordgaze-Two-N8-K4-v0")));
}

TEST_F(Train, RefusesUnknownKeys) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.clp=0.1"), "ppo.clp",
                      "did you mean 'ppo.clip'"));
  run.write("bad.toml", "[ppo]\nlanse = 8\n");
  EXPECT_TRUE(refused(run("train --config bad.toml --out a"), "bad.toml:2", "ppo.lanse",
                      "did you mean 'ppo.lanes'"));
  EXPECT_FALSE(run.has("a"));
}

TEST_F(Train, RefusesValuesOfTheWrongType) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.lanes=many"), "ppo.lanes",
                      "an integer", "many"));
  run.write("bad.toml", "frames = \"all\"\n");
  EXPECT_TRUE(
      refused(run("train --config bad.toml --out a"), "bad.toml:1", "frames", "an integer"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --seed x"), "seed", "an integer"));
}

TEST_F(Train, RefusesValuesOutOfRange) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.discount=1.5"),
                      "ppo.discount", "[0, 1]", "1.5"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --frames=-1"), "frames"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.mask_truth=odd"),
                      "ppo.mask_truth", "completed", "odd"));
}

TEST_F(Train, RefusesSettingsThatContradictEachOther) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.chunk=5"), "chunk", "steps"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set model.attention=false --set "
                          "model.task_attention=true"),
                      "task_attention", "attention"));
}

TEST_F(Train, RefusesFilesThatAreNoConfiguration) {
  EXPECT_TRUE(refused(run("train --config nothing.toml --out a"), "nothing.toml",
                      "No such file or directory"));
  EXPECT_TRUE(refused(run("train --config . --out a"), "'.'"));
  run.write("poem.toml", "Two roads diverged in a yellow wood\n");
  EXPECT_TRUE(refused(run("train --config poem.toml --out a"), "poem.toml:1", "TOML"));
}

TEST_F(Train, RefusesToMixRunsInOneFolder) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set ppo.clip=0.3"), "'a'",
                      "ppo.clip: 0.2 in"));
  EXPECT_TRUE(
      refused(run("train --config tiny.toml --out a --set ppo.clip=0.3 --resume"), "ppo.clip"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a"), "'a'", "--resume"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out tiny.toml"), "tiny.toml", "folder"));
}

TEST_F(Train, ResumesFromTheStartWhereNothingIsYet) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  const auto fresh = run("train --config tiny.toml --out b --resume");
  ASSERT_TRUE(succeeded(fresh));
  EXPECT_TRUE(contains(fresh.err, "'b'"));
  // Killed before its first checkpoint.
  ASSERT_TRUE(succeeded(run("mkdir c; cp a/config.toml c")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out c --resume")));
  for (const std::string other : {"b", "c"}) {
    EXPECT_TRUE(succeeded(
        run("diff <(cut -d, -f1,3- a/metrics.csv) <(cut -d, -f1,3- " + other + "/metrics.csv)")));
  }
}

TEST_F(Train, RefusesToResumeAnotherRun) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out b --seed 2")));
  run("mkdir f; cp a/checkpoint.safetensors f");
  EXPECT_TRUE(refused(run("train --config tiny.toml --out f --resume --set ppo.discount=0 seed=9"),
                      "f/checkpoint.safetensors", "ppo.discount: 0.99", "seed: 1"));
  EXPECT_TRUE(succeeded(run("train --config tiny.toml --out f --resume")));
  run("cp b/checkpoint.safetensors a");
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --resume"), "a/checkpoint.safetensors",
                      "seed: 2"));
  EXPECT_TRUE(
      refused(run("train --config tiny.toml --out a --resume --init b/checkpoint.safetensors"),
              "--resume", "--init"));
}

TEST_F(Train, GoesOnAndNotBack) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 512")));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --resume --frames 128"), "128", "512"));
  const auto same = run("train --config tiny.toml --out a --resume --frames 512");
  ASSERT_TRUE(succeeded(same));
  EXPECT_EQ(same.err.find("learning rate"), std::string::npos) << same.err;
  const auto longer = run("train --config tiny.toml --out a --resume --frames 5120");
  ASSERT_TRUE(succeeded(longer));
  EXPECT_TRUE(contains(longer.err, "the learning rate from 5e-05 to 0.000905"));
}

TEST_F(Train, RefusesOptionsThatAreEmpty) {
  for (const std::string option :
       {"--init", "--config", "--out", "--set", "--seed", "--frames", "--lcm-log", "--lcm-url"}) {
    EXPECT_TRUE(refused(run("train --config tiny.toml --out a " + option + " \"$UNSET\""), option))
        << option;
    EXPECT_TRUE(refused(run("wordgaze train --config tiny.toml --out a " + option + "="), option))
        << option;
  }
  EXPECT_FALSE(run.has("a"));
}

TEST_F(Train, TrainsInLevelsThatAskForLess) {
  // Three actions; no mission.
  for (const std::string id : {"MiniGrid-Dynamic-Obstacles-5x5-v0", "MiniGrid-Playground-v0"}) {
    EXPECT_TRUE(succeeded(run("train --config tiny.toml --out " + id + " --set env=" + id)));
    EXPECT_TRUE(succeeded(run("eval --checkpoint " + id + "/checkpoint.safetensors --episodes 3")));
  }
}

TEST_F(Train, HelpsEvenWhereTheHandIsFull) {
  EXPECT_TRUE(
      succeeded(run("train --config tiny.toml --out a --set curriculum.half_done_start=1 "
                    "env=BabyAI-PutNextS5N2Carrying-v0")));
  EXPECT_TRUE(succeeded(run("train --config '" WORDGAZE_SOURCE_DIR
                            "/configs/babyai/PutNextLocal.toml' --set curriculum.partial=0.3 "
                            "--frames 40000 --out b")));
}

TEST_F(Train, RefusesDamagedAndForeignCheckpoints) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  for (const std::string& damage : kDamages) {
    run("cp a/checkpoint.safetensors bad.safetensors; " + damage);
    EXPECT_TRUE(
        refused(run("train --config tiny.toml --out b --init bad.safetensors"), "bad.safetensors"))
        << damage;
  }
  run("head -c -1 a/checkpoint.safetensors >cut; mv cut a/checkpoint.safetensors");
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --resume"), "a/checkpoint.safetensors",
                      "truncated"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out b --init nothing.safetensors"),
                      "nothing.safetensors", "No such file or directory"));
}

TEST_F(Train, RefusesACheckpointOfAnotherShape) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out b --init a/checkpoint.safetensors --set "
                          "model.memory_size=12"),
                      "a/checkpoint.safetensors", "memory.input_weight", "[32, ", "[48, "));
}

TEST_F(Train, RefusesUnknownEnvironments) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set env=Wordgaze-Nine-N8-K4-v0"),
                      "Wordgaze-Nine-N8-K4-v0", "Wordgaze-One-N8-K4-v0"));
}

TEST_F(Train, RefusesARoomTooSmallForItsObjects) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --set env=Wordgaze-One-N5-K18-v0"),
                      "Wordgaze-One-N5-K18-v0", "18"));
}

TEST_F(Train, KeepsTheLastGoodCheckpointWhenTheDiskIsFull) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 64")));
  ASSERT_TRUE(succeeded(run("cp a/checkpoint.safetensors good.safetensors")));
  // No file may grow beyond 8 kB: the metrics still fit, the checkpoint does not.
  EXPECT_TRUE(refused(run("trap '' XFSZ; ulimit -f 8; "
                          "train --config tiny.toml --out a --frames 128 --resume"),
                      "a/checkpoint.safetensors", "File too large"));
  EXPECT_TRUE(succeeded(run("cmp a/checkpoint.safetensors good.safetensors")));
  EXPECT_TRUE(succeeded(run("test $(ls a | wc -l) = 3")));
  EXPECT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 128 --resume")));
}

TEST_F(Train, RefusesAnUnwritableFolder) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out /proc/nowhere"), "/proc/nowhere"));
}

TEST_F(Train, RefusesAnUnknownOption) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --sed 1"), "--sed"));
  EXPECT_TRUE(refused(run("train --config tiny.toml"), "--out"));
}

#if WORDGAZE_WITH_LCM
TEST_F(Train, LogsEpisodesAndMetrics) {
  ASSERT_TRUE(
      succeeded(run("train --config tiny.toml --out a --lcm-log a.lcmlog --set "
                    "log_episodes=1 --frames 2048")));
  const std::string log = run.read("a.lcmlog");
  for (const char* channel :
       {"WORDGAZE_EPISODE_BEGIN", "WORDGAZE_STEP", "WORDGAZE_EPISODE_END", "WORDGAZE_METRICS"}) {
    EXPECT_NE(log.find(channel), std::string::npos) << channel;
  }
}

TEST_F(Train, RefusesALogThatCannotBeWritten) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --lcm-log no/folder/a.lcmlog"),
                      "no/folder/a.lcmlog"));
}

TEST_F(Train, GoesOnWithoutAMulticastRoute) {
  if (run("unshare --user --map-root-user --net true").status != 0) {
    GTEST_SKIP() << "needs a network namespace of its own";
  }
  const Shell::Result trained =
      run("unshare --user --map-root-user --net train --config tiny.toml --out a "
          "--lcm-url 'udpm://239.255.76.67:7667?ttl=0'");
  ASSERT_TRUE(succeeded(trained));
  const std::string command = "ip route add 224.0.0.0/4 dev lo";
  const auto first = trained.err.find(command);
  ASSERT_NE(first, std::string::npos) << trained.err;
  EXPECT_EQ(trained.err.find(command, first + 1), std::string::npos) << trained.err;
}
#else
TEST_F(Train, SaysThatItWasBuiltWithoutLcm) {
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --lcm-log a.lcmlog"), "without LCM"));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --lcm-url udpm://"), "without LCM"));
}
#endif

TEST_F(Train, WritesWhatTensorBoardReads) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --tensorboard board")));
  ASSERT_TRUE(succeeded(run("ls board/events.out.tfevents.*")));
  EXPECT_TRUE(refused(run("train --config tiny.toml --out b --tensorboard a/config.toml"),
                      "a/config.toml"));
  EXPECT_FALSE(run.has("b/config.toml"));
}

}  // namespace
}  // namespace wordgaze
