#include "wordgaze/env/vector_env.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace wordgaze::env {
namespace {

using grid::Action;

struct Buffers {
  explicit Buffers(int n)
      : images(n * grid::kImageBytes),
        directions(n),
        terminated(n),
        truncated(n),
        final_images(n * grid::kImageBytes),
        final_directions(n),
        rewards(n) {}
  BatchOutput output() {
    return {.images = images,
            .directions = directions,
            .rewards = rewards,
            .terminated = terminated,
            .truncated = truncated,
            .final_images = final_images,
            .final_directions = final_directions};
  }
  bool operator==(const Buffers&) const = default;

  std::vector<std::uint8_t> images, directions, terminated, truncated, final_images,
      final_directions;
  std::vector<double> rewards;
};

std::vector<Action> random_actions(int n, core::Rng& rng) {
  std::vector<Action> actions(n);
  for (Action& action : actions) action = static_cast<Action>(rng.below(grid::kActions));
  return actions;
}

const babyai::LevelSpec kLevel = babyai::find_level("Wordgaze-Two-N6-K4-v0");

TEST(VectorEnv, GivesTheSameOnAnyNumberOfThreads) {
  constexpr int kSize = 7;
  Team two(2), three(3);
  VectorEnv alone(kLevel, kSize), on_two(kLevel, kSize, two), on_three(kLevel, kSize, three);
  Buffers a(kSize), b(kSize), c(kSize);
  alone.reset(5, a.output());
  on_two.reset(5, b.output());
  on_three.reset(5, c.output());
  core::Rng rng(1);
  for (int n = 0; n < 200; ++n) {
    ASSERT_EQ(a, b);
    ASSERT_EQ(a, c);
    const auto actions = random_actions(kSize, rng);
    alone.step(actions, a.output());
    on_two.step(actions, b.output());
    on_three.step(actions, c.output());
  }
}

TEST(VectorEnv, StepsEachEnvironmentAsIfItWereAlone) {
  constexpr int kSize = 3;
  VectorEnv batch(kLevel, kSize);
  Buffers out(kSize);
  batch.reset(20, out.output());
  std::vector<Environment> alone(kSize, Environment(kLevel));
  for (int k = 0; k < kSize; ++k) alone[k].reset(static_cast<std::uint64_t>(20 + k));
  core::Rng rng(2);
  int ended = 0;
  const auto view = [](const Environment& env) {
    std::vector<std::uint8_t> image(grid::kImageBytes);
    env.observe(std::span(image).first<grid::kImageBytes>());
    return image;
  };
  const auto kth = [](const std::vector<std::uint8_t>& images, int k) {
    return std::vector(images.begin() + k * grid::kImageBytes,
                       images.begin() + (k + 1) * grid::kImageBytes);
  };
  for (int n = 0; n < 300; ++n) {
    const auto actions = random_actions(kSize, rng);
    batch.step(actions, out.output());
    for (int k = 0; k < kSize; ++k) {
      const Transition t = alone[k].step(actions[k]);
      ASSERT_EQ(out.rewards[k], t.reward);
      ASSERT_EQ(out.terminated[k] != 0, t.terminated);
      ASSERT_EQ(out.truncated[k] != 0, t.truncated);
      if (t.terminated || t.truncated) {
        // The last view of the episode is kept; the batch shows the next episode already.
        ASSERT_EQ(kth(out.final_images, k), view(alone[k]));
        ASSERT_EQ(out.final_directions[k], alone[k].direction());
        alone[k].reset();
        ++ended;
      }
      ASSERT_EQ(kth(out.images, k), view(alone[k]));
      ASSERT_EQ(out.directions[k], alone[k].direction());
      ASSERT_EQ(batch[k].mission(), alone[k].mission());
    }
  }
  EXPECT_GT(ended, 10);
}

TEST(VectorEnv, CountsTheEpisodesThatEnded) {
  VectorEnv batch(kLevel, 1);
  Buffers out(1);
  batch.reset(0, out.output());
  core::Rng rng(3);
  std::int64_t ended = 0, successes = 0;
  double episode_return = 0;
  int length = 0;
  for (int n = 0; n < 2000; ++n) {
    batch.step(random_actions(1, rng), out.output());
    episode_return += out.rewards[0];
    ++length;
    if (out.terminated[0] == 0 && out.truncated[0] == 0) continue;
    ++ended;
    successes += episode_return > 0;
    EXPECT_EQ(batch.statistics(0).last_return, episode_return);
    EXPECT_EQ(batch.statistics(0).last_length, length);
    episode_return = 0;
    length = 0;
  }
  EXPECT_EQ(batch.statistics(0).episodes, ended);
  EXPECT_EQ(batch.statistics(0).successes, successes);
  EXPECT_GT(ended, 0);
}

TEST(VectorEnv, RefusesWhatDoesNotFitAndStepsNone) {
  VectorEnv batch(kLevel, 2);
  Buffers out(2), small(1);
  batch.reset(0, out.output());
  std::vector<Action> actions(2, Action::left);
  EXPECT_THROW(batch.step(std::span(actions).first(1), out.output()), std::invalid_argument);
  EXPECT_THROW(batch.step(actions, small.output()), std::invalid_argument);
  actions[1] = static_cast<Action>(7);
  EXPECT_THROW(batch.step(actions, out.output()), std::invalid_argument);
  EXPECT_EQ(batch[0].step_count(), 0);
  EXPECT_THROW(VectorEnv(kLevel, 0), std::invalid_argument);
}

TEST(VectorEnv, StartsEachFromASeedOfItsOwnOrWhereItsStreamIs) {
  VectorEnv batch(kLevel, 3);
  Buffers out(3);
  const core::Seed large = core::Seed::parse("123456789012345678901234567890");
  const std::vector<std::optional<core::Seed>> seeds{large, std::nullopt, core::Seed(7)};
  batch.reset(40, out.output());
  Environment expected(kLevel);
  expected.reset(41);
  expected.reset();
  batch.reset(seeds, out.output());
  EXPECT_EQ(batch[1].serialize(), expected.serialize());
  expected.reset(7);
  EXPECT_EQ(batch[2].serialize(), expected.serialize());
  expected.reset(large);
  EXPECT_EQ(batch[0].serialize(), expected.serialize());
}

TEST(VectorEnv, StartsThoseAloneThatAreChosen) {
  VectorEnv batch(kLevel, 3);
  Buffers out(3), seen(3);
  batch.reset(40, out.output());
  batch.step(std::vector<Action>(3, Action::left), out.output());
  const std::vector<std::optional<core::Seed>> seeds(3, core::Seed(9));
  batch.reset(seeds, out.output(), std::vector<std::uint8_t>{0, 1, 0});
  EXPECT_EQ(batch[0].step_count(), 1);
  EXPECT_EQ(batch[1].step_count(), 0);
  EXPECT_EQ(batch[2].step_count(), 1);
  batch.observe({.images = seen.images, .directions = seen.directions});
  EXPECT_EQ(seen.images, out.images);
  EXPECT_EQ(seen.directions, out.directions);
  EXPECT_THROW(batch.reset(std::span(seeds).first(2), out.output()), std::invalid_argument);
  EXPECT_THROW(batch.reset(seeds, out.output(), std::vector<std::uint8_t>{1}),
               std::invalid_argument);
}

TEST(VectorEnv, TakesOverAState) {
  VectorEnv batch(kLevel, 2), other(kLevel, 2);
  batch.reset(1, {});
  other.reset(5, {});
  other.restore(1, batch[0].serialize());
  EXPECT_EQ(other[1].serialize(), batch[0].serialize());
  EXPECT_THROW(other.restore(2, batch[0].serialize()), std::invalid_argument);
}

TEST(VectorEnv, LeavesOutTheBuffersThatAreNotGiven) {
  VectorEnv batch(kLevel, 2);
  batch.reset(0, {});
  const std::vector<Action> actions(2, Action::left);
  batch.step(actions, {});
  EXPECT_EQ(batch[1].step_count(), 1);
}

}  // namespace
}  // namespace wordgaze::env
