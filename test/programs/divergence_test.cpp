#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"
#include "wordgaze/core/crc32.hpp"

/// Runs whose numbers are no longer good: they end with a word, and the checkpoint before is kept.
namespace wordgaze {
namespace {

/// A file of train with every number of a tensor set to `value`, and its checksum right.
std::string with_tensor(std::string file, const std::string& name, float value) {
  std::uint64_t size = 0;
  std::memcpy(&size, file.data(), sizeof size);
  const auto header = nlohmann::json::parse(file.substr(sizeof size, size));
  const auto place = header.at(name).at("data_offsets").get<std::vector<std::size_t>>();
  for (std::size_t at = place[0]; at < place[1]; at += sizeof value) {
    std::memcpy(file.data() + sizeof size + size + at, &value, sizeof value);
  }
  const std::string key = "\"wordgaze.crc32\":\"";
  const std::size_t digits = file.find(key) + key.size();
  file.replace(digits, 8, "00000000");
  return file.replace(digits, 8, fmt::format("{:08x}", crc32(file)));
}

struct Divergence : ::testing::Test {
  Shell run;
  std::string good;

  Divergence() {
    write_tiny_config(run);
    run("train --config tiny.toml --out a --frames 256");
    good = run.read("a/checkpoint.safetensors");
  }
  /// Goes on from a checkpoint that must not be followed by a worse one.
  Shell::Result resume(const std::string& checkpoint) {
    run.write("a/checkpoint.safetensors", checkpoint);
    const auto result =
        run("train --config tiny.toml --out a --frames 1024 --resume "
            "--set checkpoint_every=50");
    EXPECT_TRUE(run.read("a/checkpoint.safetensors") == checkpoint) << "another was saved over it";
    return result;
  }
};

TEST_F(Divergence, OfTheLossIsSaidAndNotSaved) {
  // So large a value that its error has no square.
  EXPECT_TRUE(refused(resume(with_tensor(good, "critic.output.bias", 1e30f)),
                      "training has diverged", "value_loss is not finite", "--init"));
}

TEST_F(Divergence, CanBeMendedAsTheMessageSays) {
  run.write("good.safetensors", good);
  EXPECT_TRUE(
      succeeded(run("train --config tiny.toml --out b --init good.safetensors "
                    "--set ppo.learning_rate=1e-4")));
}

TEST_F(Divergence, OfWhatARunWouldGoOnFromIsNamed) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto named = [&](const char* tensor, float value, const char* name) {
    EXPECT_TRUE(refused(resume(with_tensor(good, tensor, value)), name)) << tensor;
  };
  named("memory.bias", kNan, "memory.bias");
  named("adam.mean.words", kNan, "words");
  named("adam.variance.text.bias", -1, "text.bias");
  named("adam.variance.text.bias", kInfinity, "text.bias");
  named("lanes.h", kNan, "lanes.h");
  named("lanes.c", -kInfinity, "lanes.c");
}

TEST_F(Divergence, IsNotWhatTheLargestLearningRateLeadsTo) {
  EXPECT_TRUE(
      succeeded(run("train --config tiny.toml --out b --frames 12800 --set ppo.learning_rate=1 "
                    "ppo.task_learning_rate=1 ppo.learning_rate_end=1 ppo.gradient_norm=1e6 "
                    "ppo.value_coefficient=100 ppo.entropy_start=10 ppo.entropy_end=10")));
  EXPECT_TRUE(succeeded(run("eval --checkpoint b/checkpoint.safetensors --episodes 2")));
}

}  // namespace
}  // namespace wordgaze
