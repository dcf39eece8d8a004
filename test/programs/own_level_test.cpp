#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "programs/shell.hpp"
#include "programs/tiny_run.hpp"

namespace wordgaze {
namespace {

constexpr const char* kLevel = R"(
map = """
#######
#A.D.b#
#.k#..#
#######
"""
legend = ["D = locked red door", "k = red key", "b = ball"]
objects = "box"
missions = ["pick up the ball", "go to {}"]
)";

struct OwnLevel : ::testing::Test {
  OwnLevel() {
    run.write("mine.toml", kLevel);
    write_tiny_config(run);
  }
  Shell run;
};

TEST_F(OwnLevel, TrainsGoesOnAndEvaluates) {
  const std::string train = "train --config tiny.toml --out out ";
  ASSERT_TRUE(succeeded(run(train + "--level mine.toml")));
  // The level is in the configuration and in the checkpoint.
  EXPECT_NE(run.read("out/config.toml").find("env = \"Own-mine-v0\""), std::string::npos);
  EXPECT_TRUE(succeeded(run(train + "--level mine.toml --resume --frames 192")));
  EXPECT_TRUE(succeeded(run("train --config out/config.toml --out out --resume --frames 256")));
  EXPECT_TRUE(refused(run(train + "--resume --frames 320"), "Own-mine-v0", "--level"));
  run("sed -i 's/box/2 boxes/' mine.toml");
  EXPECT_TRUE(refused(run(train + "--level mine.toml --resume --frames 320"), "level"));
  // Nothing but the checkpoint is needed.
  run("rm mine.toml");
  const auto evaluated =
      run("eval --checkpoint out/checkpoint.safetensors --episodes 4 --threads 1 --greedy");
  EXPECT_TRUE(succeeded(evaluated));
  EXPECT_NE(evaluated.out.find("Own-mine-v0"), std::string::npos);
}

TEST_F(OwnLevel, TheExpertSolvesIt) {
  const auto evaluated = run("eval --policy bot --level mine.toml --episodes 20 --threads 1");
  ASSERT_TRUE(succeeded(evaluated));
  EXPECT_NE(evaluated.out.find("100.0%"), std::string::npos) << evaluated.out;
}

TEST_F(OwnLevel, IsTracedReplayedMeasuredAndListed) {
  ASSERT_TRUE(succeeded(run("trace --level mine.toml --seeds 0:2 --steps 60 --out t.jsonl")));
  EXPECT_TRUE(refused(run("trace --replay t.jsonl"), "Own-mine-v0"));
  const auto replayed = run("trace --replay t.jsonl --level mine.toml");
  ASSERT_TRUE(succeeded(replayed));
  EXPECT_NE(replayed.out.find("mismatches 0"), std::string::npos);
  EXPECT_TRUE(succeeded(run("bench --level mine.toml --sim Own-mine-v0 --envs 4 --steps 100")));
  const auto listed = run("wordgaze levels Own- --level mine.toml --pictures pictures");
  ASSERT_TRUE(succeeded(listed));
  EXPECT_NE(listed.out.find("Own-mine-v0"), std::string::npos);
  EXPECT_EQ(run.read("pictures/Own-mine-v0.png").substr(1, 3), "PNG");
}

TEST_F(OwnLevel, HostileFilesAreRefusedByName) {
  const auto refuse = [&](const std::string& content, const char* says) {
    run.write("bad.toml", content);
    for (const char* command :
         {"train --out bad --level bad.toml", "wordgaze levels --level bad.toml"}) {
      EXPECT_TRUE(refused(run(command), "bad.toml", says)) << content.substr(0, 100);
    }
    EXPECT_FALSE(run.has("bad"));
  };
  refuse("map = \"\"\"\n#A?\n\"\"\"", "'?'");
  refuse("misions = \"go to {}\"", "did you mean 'missions'");
  refuse("room_size = 100000\nobjects = \"goal\"", "room_size");
  refuse("room_size = \"8\"", "expected an integer");
  refuse("missions = [\"go to {}\", 3]", "missions");
  refuse("map = [[\"a\"]]", "map");
  refuse("objects = \"999999999999999999999 balls\"", "balls");
  refuse("[=", "not valid TOML");
  refuse(std::string(3000, '['), "brackets");
  refuse("map = \"" + std::string((1 << 20) + 1, '#') + "\"", "bytes");
  refuse("map = \"" + std::string(1025, '.') + "\"", "1024");
  refuse("objects = \"goal\"\nid = \"with space\"", "with space");
  refuse("objects = \"goal\"\nid = \"BabyAI-GoToLocal-v0\"", "BabyAI-GoToLocal-v0");
  EXPECT_TRUE(refused(run("train --out bad --level none.toml"), "none.toml"));
  EXPECT_TRUE(
      refused(run("eval --policy bot --level mine.toml --env BabyAI-GoToLocal-v0"), "--env"));
}

TEST_F(OwnLevel, ExamplesAreLevels) {
  const std::filesystem::path folder = WORDGAZE_SOURCE_DIR "/configs/levels";
  int levels = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++levels;
    const auto bot =
        run("eval --policy bot --episodes 50 --threads 1 --level '" + entry.path().string() + "'");
    EXPECT_TRUE(succeeded(bot));
    EXPECT_NE(bot.out.find("100.0%"), std::string::npos) << bot.out;  // it can be solved
  }
  EXPECT_GE(levels, 1);
}

}  // namespace
}  // namespace wordgaze
