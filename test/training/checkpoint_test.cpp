// Checkpoints: the same bytes for the same run, and nothing that is believed before it is checked.
#include "wordgaze/training/checkpoint.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/policy/trained_agent.hpp"

namespace wordgaze::training {
namespace {

using policy::Agent;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TrainConfig tiny() {
  TrainConfig c;
  c.env = "Wordgaze-Two-N6-K3-v0";
  c.threads = 1;
  c.probe_every = 0;
  c.model.channels = c.model.word_size = c.model.key_size = 4;
  c.model.memory_size = c.model.text_size = c.model.head_size = c.model.task_size = 6;
  c.model.task_attention = true;
  c.ppo = {.lanes = 4, .steps = 6, .chunk = 6, .epochs = 1, .minibatches = 1};
  c.curriculum = {.pickup_first = false, .half_done_start = 0.3, .half_done_end = 0.3};
  return c;
}

struct Checkpoint : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "checkpoint.safetensors";
  const TrainConfig config = tiny();
  Trainer trainer{config};
  io::TensorMap map;

  Checkpoint() {
    for (int update = 0; update < 3; ++update) trainer.update();
    save_checkpoint(path, config, trainer.state());
    map = io::read_safetensors(path);
  }

  template <class T>
  std::vector<T>& values(const std::string& name) {
    return std::get<std::vector<T>>(map.tensors.at(name).values);
  }
  auto load() { return load_state<Agent>(path, trainer); }
  /// Of the file with this change, its checksum right.
  std::string refusal(const std::function<void()>& change) {
    const io::TensorMap before = map;
    change();
    io::write_safetensors(path, map);
    map = before;
    return message_of<std::runtime_error>([&] { load(); });
  }
  /// Whether it was taken. What is taken must work, or say why it does not.
  bool taken(const std::function<void()>& change) {
    const io::TensorMap before = map;
    change();
    io::write_safetensors(path, map);
    map = before;
    try {
      trainer.restore(load());
    } catch (const std::exception& error) {
      EXPECT_TRUE(contains(error.what(), "checkpoint.safetensors"));
      return false;
    }
    try {
      trainer.update();
    } catch (const std::exception&) {
    }
    return true;
  }
};

TEST_F(Checkpoint, OfTheSameRunHasTheSameBytes) {
  Trainer again(config);
  for (int update = 0; update < 3; ++update) again.update();
  save_checkpoint(folder / "again", config, again.state());
  EXPECT_EQ(io::read_file(folder / "again"), io::read_file(path));
}

TEST_F(Checkpoint, LetsARunGoOnBitForBit) {
  Trainer resumed(config);
  resumed.restore(load());
  trainer.update();
  resumed.update();
  save_checkpoint(path, config, trainer.state());
  save_checkpoint(folder / "resumed", config, resumed.state());
  EXPECT_EQ(io::read_file(folder / "resumed"), io::read_file(path));
}

TEST_F(Checkpoint, OfAnOlderProgramHasItsSecondsInIt) {
  map.tensors["train.reals"] = {{2}, std::vector<double>{12.5, 0.25}};
  io::write_safetensors(path, map);
  EXPECT_EQ(load().hit_12, 0.25);
  EXPECT_EQ(load().seconds, 0);
}

TEST_F(Checkpoint, RefusesCountersOutOfTheirRanges) {
  constexpr std::int64_t kHuge = std::int64_t{1} << 62;
  for (const char* name : {"train.counters", "lanes.counters", "lanes.environment_size"}) {
    for (std::size_t k = 0; k < values<std::int64_t>(name).size(); ++k) {
      for (const std::int64_t value : {std::int64_t{-1}, kHuge, -kHuge}) {
        EXPECT_TRUE(contains(refusal([&] { values<std::int64_t>(name)[k] = value; }), name));
      }
    }
    const auto message = refusal([&] {
      for (auto& value : values<std::int64_t>(name)) value = -1;
    });
    EXPECT_TRUE(contains(message, formatted(": {}[", name)));
    EXPECT_TRUE(contains(message, "] is -1; expected 0 to "));
  }
  EXPECT_TRUE(contains(refusal([&] { values<std::int64_t>("train.counters")[1] += 1; }),
                       "train.counters[1] is 73; expected 72 to 72"));
}

TEST_F(Checkpoint, RefusesRealsOutOfTheirRanges) {
  ASSERT_GT(values<double>("train.outcomes").size(), 0u);
  for (const char* name : {"train.curriculum", "train.outcomes", "lanes.return"}) {
    for (std::size_t k = 0; k < values<double>(name).size(); ++k) {
      if (k > 20 && k % 97 != 0) continue;
      for (const double value : {kNaN, kInfinity, -kInfinity, 1e300, -1e300, -0.5 - 1.0}) {
        EXPECT_TRUE(contains(refusal([&] { values<double>(name)[k] = value; }), name)) << k;
      }
    }
  }
  EXPECT_TRUE(contains(refusal([&] { values<double>("train.reals")[0] = 1e300; }), "train.reals"));
  EXPECT_TRUE(
      contains(refusal([&] { values<double>("train.curriculum")[3] = 0.5; }),
               "train.curriculum: Curriculum: number 3 of a state is 0.5; expected a whole"));
}

TEST_F(Checkpoint, RefusesRandomStreamsThatAreNone) {
  for (const char* name : {"train.rng", "lanes.rng"}) {
    EXPECT_TRUE(contains(refusal([&] { values<std::int64_t>(name)[3] ^= 1; }), "is even"));
    EXPECT_TRUE(contains(refusal([&] { values<std::int64_t>(name)[4] = -1; }), name));
    EXPECT_TRUE(contains(refusal([&] { values<std::int64_t>(name)[5] = 2; }), name));
  }
}

TEST_F(Checkpoint, NamesTheTensorThatIsNotFinite) {
  for (const auto& [name, tensor] : io::TensorMap(map).tensors) {
    if (!std::holds_alternative<std::vector<float>>(tensor.values)) continue;
    for (const double value : {kNaN, kInfinity, -kInfinity}) {
      const auto message =
          refusal([&, &name = name] { values<float>(name).back() = static_cast<float>(value); });
      EXPECT_TRUE(contains(message, ": " + name + "[")) << value;
      EXPECT_TRUE(contains(message, "expected finite numbers"));
      if (name.starts_with("adam.") || name.starts_with("lanes.")) continue;
      for (const auto& reading :
           {std::function<void()>([&] { load_params<Agent>(path, trainer); }),
            std::function<void()>([&] { policy::TrainedAgent::load(path); })}) {
        EXPECT_TRUE(contains(message_of<std::runtime_error>(reading), ": " + name + "["));
      }
    }
  }
}

TEST_F(Checkpoint, RefusesANegativeVariance) {
  EXPECT_TRUE(contains(refusal([&] { values<float>("adam.variance.words")[7] = -1; }),
                       "adam.variance.words is negative"));
}

TEST_F(Checkpoint, RefusesAFocusBeyondTheWhole) {
  EXPECT_TRUE(contains(refusal([&] { values<float>("attention.focus")[0] = 1e30f; }),
                       "attention.focus is 1e+30; expected a share in [0, 1]"));
}

TEST_F(Checkpoint, RefusesSizesThatItsTensorsDoNotHaveBeforeItMakesRoomForThem) {
  for (const auto& [setting, size] : {std::pair{"channels", 1024},
                                      {"word_size", 1024},
                                      {"key_size", 1024},
                                      {"memory_size", 4096},
                                      {"text_size", 4096},
                                      {"head_size", 4096},
                                      {"channels", 5}}) {
    auto larger = config;
    io::set_option(larger, formatted("model.{}={}", setting, size));
    auto lying = map;
    lying.metadata["wordgaze.config"] = io::to_toml(larger);
    io::write_safetensors(path, lying);
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { policy::TrainedAgent::load(path); }),
                         formatted("but model.{} in its configuration asks for ", setting)));
  }
}

TEST_F(Checkpoint, RefusesAConfigurationWithoutEnd) {
  for (const std::string& toml : {"[a" + std::string(60'000, '.'), std::string(60'000, '['),
                                  std::string(2'000'000, ' '), std::string("[= x")}) {
    auto hostile = map;
    hostile.metadata["wordgaze.config"] = toml;
    io::write_safetensors(path, hostile);
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { load_config(path); }),
                         "checkpoint.safetensors': wordgaze.config"));
    EXPECT_THROW(policy::TrainedAgent::load(path), std::runtime_error);
  }
}

TEST_F(Checkpoint, IsNotReplacedByOneThatIsNotFinite) {
  const std::string good = io::read_file(path);
  auto state = trainer.state();
  state.params.memory.bias(2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { save_checkpoint(path, config, state); }),
               "memory.bias[2, 0] is nan"));
  state = trainer.state();
  state.adam_variance.words(1, 1) = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { save_checkpoint(path, config, state); }),
               "adam.variance.words[1, 1] is inf"));
  EXPECT_EQ(io::read_file(path), good);
}

TEST_F(Checkpoint, AnyNumberAlteredIsRefusedOrDoesNoHarm) {
  core::Rng rng(1);
  const auto pick = [&](const auto& list) {
    return static_cast<std::size_t>(rng.below(static_cast<int>(list.size())));
  };
  std::vector<std::string> names;
  for (const auto& [name, tensor] : map.tensors) names.push_back(name);
  for (int tries = 0; tries < 400; ++tries) {
    const std::string& name = names[pick(names)];
    taken([&] {
      std::visit(
          [&](auto& numbers) {
            using T = typename std::remove_cvref_t<decltype(numbers)>::value_type;
            constexpr std::array<double, 8> kReals{kNaN, kInfinity, -1, 0, 1, 1e30, -1e30, 1e300};
            constexpr std::array<std::int64_t, 8> kWholes{-1, 0, 1, 2, 255, 400, 1LL << 62, 3};
            T& number = numbers[pick(numbers)];
            if constexpr (std::floating_point<T>) {
              number = static_cast<T>(kReals[pick(kReals)]);
            } else {
              number = static_cast<T>(kWholes[pick(kWholes)]);
            }
          },
          map.tensors.at(name).values);
    });
  }
}

TEST_F(Checkpoint, AnEnvironmentAlteredIsRefusedOrDoesNoHarm) {
  constexpr std::size_t kFrame = 16;  // mark and checksum
  core::Rng rng(2);
  int refused = 0;
  for (int tries = 0; tries < 400; ++tries) {
    refused += !taken([&] {
      auto& bytes = values<std::uint8_t>("lanes.environment");
      const auto size = static_cast<std::size_t>(values<std::int64_t>("lanes.environment_size")[0]);
      const auto at = kFrame + static_cast<std::size_t>(rng.below(static_cast<int>(size - kFrame)));
      bytes[at] ^= static_cast<std::uint8_t>(1 + rng.below(255));
      std::uint64_t h = 0xCBF29CE484222325;  // FNV-1a
      for (std::size_t i = kFrame; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001B3;
      std::memcpy(bytes.data() + 8, &h, sizeof h);
    });
  }
  EXPECT_GT(refused, 200);
  EXPECT_LT(refused, 400);
}

TEST_F(Checkpoint, RefusesAnEnvironmentWithoutAnEpisode) {
  EXPECT_TRUE(contains(refusal([&] {
                         const auto blank = env::Environment(config.env).serialize();
                         std::vector<std::uint8_t> all;
                         for (auto& size : values<std::int64_t>("lanes.environment_size")) {
                           size = static_cast<std::int64_t>(blank.size());
                           all.insert(all.end(), blank.begin(), blank.end());
                         }
                         const auto total = static_cast<std::int64_t>(all.size());
                         map.tensors["lanes.environment"] = {{total}, std::move(all)};
                       }),
                       "lanes.environment, lane 0: no episode has begun"));
}

}  // namespace
}  // namespace wordgaze::training
