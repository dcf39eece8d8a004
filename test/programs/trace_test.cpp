#include <gtest/gtest.h>

#include "programs/shell.hpp"
#include "support/messages.hpp"

namespace wordgaze {
namespace {

struct Trace : ::testing::Test {
  Shell run;

  void write_small_trace() {
    const Shell::Result written =
        run("trace --env BabyAI-GoToLocal-v0 --seeds 0:3 --policy random --steps 50 "
            "--out t.jsonl");
    ASSERT_EQ(written.status, 0) << written.err;
  }
};

TEST_F(Trace, ReplaysWhatItWrote) {
  write_small_trace();
  const Shell::Result replayed = run("trace --replay t.jsonl");
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_NE(replayed.out.find("mismatches 0"), std::string::npos) << replayed.out;
}

TEST_F(Trace, LetsTheBotActWhoSucceeds) {
  const Shell::Result written =
      run("trace --env BabyAI-GoToLocal-v0 --seeds 0:1 --policy bot --steps 50 --out t.jsonl");
  ASSERT_EQ(written.status, 0) << written.err;
  const int ended = std::stoi(run("grep -c '\"term\":true' t.jsonl").out);
  const int unrewarded = std::stoi(run("grep '\"term\":true' t.jsonl | grep -c '\"r\":0.0'").out);
  EXPECT_GT(ended, 3);
  EXPECT_EQ(unrewarded, 0);
}

TEST_F(Trace, RefusesAnUnknownPolicy) {
  EXPECT_TRUE(refused(run("trace --env BabyAI-GoToLocal-v0 --policy clever"), "clever"));
}

TEST_F(Trace, ReplaysStandardInput) {
  write_small_trace();
  const Shell::Result replayed = run("cat t.jsonl | trace --replay -");
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_NE(replayed.out.find("mismatches 0"), std::string::npos) << replayed.out;
}

TEST_F(Trace, TellsWhereAReplayDeviates) {
  write_small_trace();
  // Another reward in one step of the trace.
  run(R"(sed -i '0,/"r":0[^,]*/s//"r":0.5/' t.jsonl)");
  const Shell::Result replayed = run("trace --replay t.jsonl");
  EXPECT_EQ(replayed.status, 1);
  EXPECT_NE(replayed.out.find("mismatches 1"), std::string::npos) << replayed.out;
  EXPECT_NE((replayed.out + replayed.err).find("0.5"), std::string::npos) << replayed.out;
}

TEST_F(Trace, RefusesAnUnknownEnvironment) {
  EXPECT_TRUE(refused(
      run("trace --env BabyAI-GoToLokal-v0 --seeds 0:1 --policy random --steps 1 --out t.jsonl"),
      "BabyAI-GoToLokal-v0", "BabyAI-GoToLocal-v0"));
}

TEST_F(Trace, RefusesAnUnknownEnvironmentInAReplay) {
  write_small_trace();
  run("sed -i 's/GoToLocal/GoToPinkBall/' t.jsonl");
  EXPECT_TRUE(refused(run("trace --replay t.jsonl"), "BabyAI-GoToPinkBall-v0"));
}

TEST_F(Trace, RefusesARoomTooSmallForItsObjects) {
  EXPECT_TRUE(
      refused(run("trace --env Wordgaze-One-N5-K30-v0 --seeds 0:1 --policy random --steps 1 "
                  "--out t.jsonl"),
              "Wordgaze-One-N5-K30-v0", "30"));
}

TEST_F(Trace, RefusesMissingAndForeignFiles) {
  EXPECT_TRUE(refused(run("trace --replay nothing.jsonl"), "nothing.jsonl"));
  run.write("poem.txt", "Two roads diverged in a yellow wood\n");
  EXPECT_TRUE(refused(run("trace --replay poem.txt"), "line 1"));
}

TEST_F(Trace, ReplayingNothingIsAnError) {
  run.write("empty.jsonl", "");
  run.write("meta.jsonl", "{\"t\":\"meta\"}\n");
  for (const std::string nothing : {".", "empty.jsonl", "meta.jsonl", "/dev/null", "-"}) {
    const auto replayed = run("trace --replay " + nothing);
    EXPECT_TRUE(refused(replayed, "trace")) << nothing;
    EXPECT_EQ(replayed.out.find("mismatches"), std::string::npos) << nothing;
  }
}

TEST_F(Trace, RefusesToWriteOverTheAgent) {
  const std::string model = WORDGAZE_SOURCE_DIR "/models/single-attention.safetensors";
  run("cp '" + model + "' w; ln -s w link");
  for (const std::string out : {"w", "link"}) {
    EXPECT_TRUE(
        refused(run("trace --env Wordgaze-One-N8-K4-v0 --checkpoint w --steps 3 --out " + out),
                "--out", "--checkpoint"));
  }
  EXPECT_TRUE(succeeded(run("cmp w '" + model + "'")));
}

TEST_F(Trace, LeavesTheOldFileWhereTheNewOneIsNotWhole) {
  write_small_trace();
  run("cp t.jsonl before");
  const std::string endless =
      "trace --env BabyAI-GoToLocal-v0 --seeds 0:3 --steps 1000000000 --out t.jsonl";
  const auto stopped = run("timeout --foreground --preserve-status --signal=TERM 1 " + endless);
  EXPECT_EQ(stopped.status, 143) << describe(stopped);
  EXPECT_TRUE(contains(stopped.err, "stopped by a signal"));
  EXPECT_TRUE(refused(run("ulimit -f 64; " + endless), "t.jsonl", "File too large"));
  EXPECT_TRUE(refused(run("trace --env BabyAI-GoToLocal-v0,BabyAI-GoToLokal-v0 --out t.jsonl"),
                      "BabyAI-GoToLokal-v0"));
  EXPECT_TRUE(succeeded(run("cmp t.jsonl before && ! ls | grep tmp")));
}

TEST_F(Trace, SaysThatStandardOutputIsFull) {
  EXPECT_TRUE(refused(run("trace --env BabyAI-GoToLocal-v0 --seeds 0:1 --steps 3 >/dev/full"),
                      "standard output", "No space left on device"));
}

TEST_F(Trace, RefusesATruncatedFile) {
  write_small_trace();
  run("head -c -100 t.jsonl >cut.jsonl");
  EXPECT_TRUE(refused(run("trace --replay cut.jsonl"), "line"));
}

TEST_F(Trace, RefusesSeedsThatAreNoRange) {
  for (const std::string seeds : {"5", "3:1", "-1:2", "a:b"}) {
    EXPECT_TRUE(refused(run("trace --env BabyAI-GoToLocal-v0 --seeds=" + seeds +
                            " --policy random --steps 1 --out t.jsonl"),
                        "seeds"))
        << seeds;
  }
}

}  // namespace
}  // namespace wordgaze
