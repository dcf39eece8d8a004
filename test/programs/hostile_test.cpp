// Files and arguments that nobody means well, or at all.
#include <gtest/gtest.h>

#include <chrono>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"

namespace wordgaze {
namespace {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

struct Hostile : ::testing::Test {
  Shell run;
  Hostile() { write_tiny_config(run); }

  /// As refused(), within seconds and with a message that can be read.
  template <class... Parts>
  ::testing::AssertionResult refused_at_once(const std::string& command, const Parts&... parts) {
    const auto start = std::chrono::steady_clock::now();
    const auto result = run("timeout 20 " + command);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (time.count() > 15) {
      return ::testing::AssertionFailure() << "it took " << time.count() << " s";
    }
    if (result.err.size() > 5000) {
      return ::testing::AssertionFailure() << "a message of " << result.err.size() << " bytes";
    }
    return refused(result, parts...);
  }
};

TEST_F(Hostile, ConfigurationsWithoutEnd) {
  run.write("deep.toml", "[a" + repeated(".a", 50'000) + "]\n");
  EXPECT_TRUE(refused_at_once("train --config deep.toml --out a", "deep.toml", "2000 dots"));
  run.write("lists.toml", "frames = " + repeated("[", 100'000));
  EXPECT_TRUE(refused_at_once("train --config lists.toml --out a", "lists.toml"));
  run.write("asserted.toml", "[= x");
  EXPECT_TRUE(refused_at_once("train --config asserted.toml --out a", "asserted.toml", "TOML"));
  EXPECT_TRUE(refused_at_once("train --config /dev/zero --out a", "/dev/zero", "1048576"));
  EXPECT_TRUE(refused_at_once(
      "train --config tiny.toml --out a --set frames=" + repeated("[", 50'000), "--set"));
  EXPECT_FALSE(run.has("a"));
}

TEST_F(Hostile, PipesAndDevicesInPlaceOfFiles) {
  ASSERT_TRUE(succeeded(run("mkfifo pipe")));
  EXPECT_TRUE(refused_at_once("train --config pipe --out a", "'pipe'", "nobody writes"));
  for (const std::string name : {"pipe", "/dev/zero", "/dev/null", "."}) {
    EXPECT_TRUE(refused_at_once("eval --checkpoint " + name + " --episodes 1", "'" + name + "'"));
    EXPECT_TRUE(refused_at_once("trace --replay " + name, "'" + name + "'"));
    EXPECT_TRUE(
        refused_at_once("train --config tiny.toml --out a --init " + name, "'" + name + "'"));
  }
}

TEST_F(Hostile, AConfigurationMayComeThroughAPipe) {
  EXPECT_TRUE(succeeded(run("train --config <(sed s/128/64/ tiny.toml) --out a")));
  EXPECT_TRUE(contains(run.read("a/config.toml"), "frames = 64\n"));
  EXPECT_TRUE(succeeded(run("train --config /dev/stdin --out b <tiny.toml")));
  EXPECT_TRUE(succeeded(run("cat tiny.toml | train --config /dev/stdin --out c")));
}

TEST_F(Hostile, TracesWithoutEnd) {
  run.write("deep.jsonl", "{\"t\":\"reset\",\"mission\":" + repeated("[", 100'000));
  EXPECT_TRUE(refused_at_once("trace --replay deep.jsonl", "line 1", "nested too deeply"));
  run.write("closed.jsonl",
            "{\"t\":\"reset\",\"env\":\"BabyAI-GoToObj-v0\",\"seed\":1,\"mission\":" +
                repeated("[", 100'000) + repeated("]", 100'000) + "}");
  EXPECT_TRUE(refused_at_once("trace --replay closed.jsonl", "line 1", "nested too deeply"));
  run.write("seed.jsonl", "{\"t\":\"reset\",\"env\":\"BabyAI-GoToObj-v0\",\"seed\":\"" +
                              repeated("7", 1'000'000) + "\"}");
  EXPECT_TRUE(refused_at_once("trace --replay seed.jsonl", "at most 10000 digits"));
  for (const std::string& id : {"Wordgaze-" + repeated("a", 26'300), repeated("x", 1'000'000)}) {
    run.write("id.jsonl", "{\"t\":\"reset\",\"env\":\"" + id + "\",\"seed\":1}");
    EXPECT_TRUE(refused_at_once("trace --replay id.jsonl", "unknown environment"));
  }
  run.write("empty.jsonl", "");
  EXPECT_TRUE(refused_at_once("trace --replay empty.jsonl", "nothing was compared"));
  EXPECT_TRUE(refused_at_once("trace --replay - </dev/zero", "line 1"));
}

TEST_F(Hostile, EnvironmentsWithoutEnd) {
  run.write("env.toml", "env = \"" + repeated("x", 100'000) + "\"\n");
  EXPECT_TRUE(refused_at_once("train --config env.toml --out a", "unknown environment"));
  EXPECT_TRUE(refused_at_once("eval --policy bot --env Wordgaze-" + repeated("a", 26'300),
                              "unknown environment"));
  EXPECT_TRUE(refused_at_once("eval --policy bot --env Wordgaze-One-N99999-K4-v0",
                              "room_size = 99999; expected"));
}

TEST_F(Hostile, NumbersThatAreNone) {
  const std::string bot = "eval --policy bot --env BabyAI-GoToObj-v0 --episodes 1 ";
  for (const char* seed : {"-1", "18446744073709551616", "''", "'1 x'", "0x10", "1.5", "' 1'"}) {
    EXPECT_TRUE(refused_at_once(bot + "--seed " + seed, "--seed", "expected an integer"));
    EXPECT_TRUE(refused_at_once(std::string("train --config tiny.toml --out a --seed ") + seed,
                                "--seed", "expected an integer"));
    EXPECT_TRUE(refused_at_once(std::string("trace --env BabyAI-GoToObj-v0 --policy-seed ") + seed,
                                "--policy-seed"));
  }
  for (const char* seeds :
       {"-1:2", "0:18446744073709551616", "' '", "'0:1 x'", "3", ":", "2:1", "0:"}) {
    EXPECT_TRUE(refused_at_once(std::string("trace --env BabyAI-GoToObj-v0 --seeds ") + seeds,
                                "expected A:B"));
  }
  for (const char* option :
       {"--rooms ''", "--rooms 8x", "--rooms 99999999999", "--objects -1", "--threads ''",
        "--episodes 1.5e0", "--episodes 1e-3", "--episodes 1e99"}) {
    EXPECT_TRUE(refused_at_once(bot + option, "expected an integer"));
  }
  EXPECT_TRUE(succeeded(run(bot + "--seed 18446744073709551615")));
}

TEST_F(Hostile, CheckpointsWithoutTheirChecksumAreSaidToBeUnchecked) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  ASSERT_TRUE(succeeded(run("sed -i s/wordgaze.crc32/wordgaze.crc33/ a/checkpoint.safetensors")));
  const auto read = run("eval --checkpoint a/checkpoint.safetensors --episodes 1 --threads 1");
  EXPECT_TRUE(succeeded(read));
  EXPECT_TRUE(contains(read.err, "a/checkpoint.safetensors' has no checksum"));
}

TEST_F(Hostile, HolesInTheMetricsAreSaidAndAForeignFileStays) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --frames 256")));
  const auto resumed = [&] {
    return run("train --config tiny.toml --out a --frames 256 --resume");
  };
  EXPECT_EQ(resumed().err.find("hole"), std::string::npos);
  ASSERT_TRUE(succeeded(run("sed -i 3d a/metrics.csv")));
  EXPECT_TRUE(contains(resumed().err, "rows between frames 64 and 192 are missing"));
  ASSERT_TRUE(succeeded(run("rm a/metrics.csv")));
  EXPECT_TRUE(contains(resumed().err, "the file is not there"));
  ASSERT_TRUE(succeeded(run("mkdir b; echo mine,yours >b/metrics.csv")));
  EXPECT_TRUE(refused_at_once("train --config tiny.toml --out b", "b/metrics.csv", "mine,yours"));
  EXPECT_EQ(run.read("b/metrics.csv"), "mine,yours\n");
}

TEST_F(Hostile, TheSameTrainingWritesTheSameBytesAndLeavesNoTemporaryFile) {
  ASSERT_TRUE(succeeded(run("mkdir a; echo >a/checkpoint.safetensors.$(sh -c 'echo $$').tmp")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out b")));
  EXPECT_TRUE(succeeded(run("cmp a/checkpoint.safetensors b/checkpoint.safetensors")));
  EXPECT_EQ(run("ls a").out, "checkpoint.safetensors\nconfig.toml\nmetrics.csv\n");
}

}  // namespace
}  // namespace wordgaze
