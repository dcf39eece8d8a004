#include "wordgaze/training/checkpoint.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace wordgaze::training {
namespace {

/// Small, and with everything that a state can hold: clauses, stretched and helped episodes.
TrainConfig small() {
  TrainConfig c;
  c.env = "Wordgaze-Two-N8-K3-v0";
  c.threads = 1;
  c.probe_every = 100;
  c.model.task_attention = true;
  c.model.memory_size = 8;
  c.ppo.lanes = 6;
  c.ppo.steps = 10;
  c.ppo.chunk = 5;
  c.ppo.epochs = 1;
  c.ppo.minibatches = 2;
  c.curriculum.pickup_first = false;
  c.curriculum.half_done_start = c.curriculum.half_done_end = 0.5;
  return c;
}

void expect_same(const policy::Agent::Params& a, const policy::Agent::Params& b, const char* what) {
  nn::for_each_parameter([&](const nn::Path& path, const auto& x,
                             const auto& y) { EXPECT_TRUE(x == y) << what << "." << path.str(); },
                         a, b);
}

TEST(CheckpointRoundTrip, HoldsTheWholeStateOfTraining) {
  const TemporaryFolder folder;
  const auto path = folder / "checkpoint.safetensors";
  Trainer trainer(small());
  for (int k = 0; k < 12; ++k) trainer.update();
  const auto wrote = trainer.state();
  save_checkpoint(path, small(), wrote);
  const auto read = load_state<policy::Agent>(path, Trainer(small()));

  EXPECT_EQ(read.updates, wrote.updates);
  EXPECT_EQ(read.frames, wrote.frames);
  EXPECT_EQ(read.adam_steps, wrote.adam_steps);
  EXPECT_EQ(read.rng, wrote.rng);
  EXPECT_EQ(read.curriculum, wrote.curriculum);
  EXPECT_EQ(read.hit_12, wrote.hit_12);
  expect_same(read.params, wrote.params, "weights");
  expect_same(read.adam_mean, wrote.adam_mean, "mean");
  expect_same(read.adam_variance, wrote.adam_variance, "variance");
  ASSERT_EQ(read.recent.size(), wrote.recent.size());
  EXPECT_FALSE(wrote.recent.empty());
  for (std::size_t i = 0; i < wrote.recent.size(); ++i) {
    const Outcome &a = read.recent[i], &b = wrote.recent[i];
    EXPECT_EQ(
        std::tie(a.success, a.truncated, a.steps, a.episode_return, a.verb, a.clauses, a.helped),
        std::tie(b.success, b.truncated, b.steps, b.episode_return, b.verb, b.clauses, b.helped));
  }
  ASSERT_EQ(read.lanes.size(), wrote.lanes.size());
  int helped = 0;
  for (std::size_t i = 0; i < wrote.lanes.size(); ++i) {
    const auto &a = read.lanes[i], &b = wrote.lanes[i];
    EXPECT_EQ(a.environment, b.environment);
    EXPECT_EQ(a.rng, b.rng);
    EXPECT_EQ(a.helped, b.helped);
    EXPECT_EQ(a.stretch, b.stretch);
    EXPECT_EQ(a.episode, b.episode);
    EXPECT_EQ(a.episode_return, b.episode_return);
    EXPECT_EQ(a.memory.begins, b.memory.begins);
    EXPECT_EQ(a.memory.h, b.memory.h);
    EXPECT_EQ(a.memory.c, b.memory.c);
    helped += b.helped;
  }
  EXPECT_GT(helped, 0);
}

TEST(CheckpointRoundTrip, ARunGoesOnFromItBitForBit) {
  const TemporaryFolder folder;
  const auto path = folder / "checkpoint.safetensors";
  Trainer whole(small());
  for (int k = 0; k < 3; ++k) whole.update();
  save_checkpoint(path, small(), whole.state());
  Trainer resumed(small());
  resumed.restore(load_state<policy::Agent>(path, resumed));
  for (int k = 0; k < 3; ++k) {
    whole.update();
    resumed.update();
  }
  expect_same(resumed.params(), whole.params(), "weights");
  EXPECT_EQ(resumed.frames(), whole.frames());
}

}  // namespace
}  // namespace wordgaze::training
