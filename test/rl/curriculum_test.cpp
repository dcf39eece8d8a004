#include "wordgaze/rl/curriculum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace wordgaze::rl {
namespace {

Curriculum half_done(double share) {
  return Curriculum(
      {.pickup_first = false, .balance = false, .half_done_start = share, .half_done_end = share});
}

/// The clauses marked at the starts of 200 episodes, as lists of 0/1.
std::set<std::vector<int>> starts(const char* id, babyai::Order order) {
  const Curriculum curriculum = half_done(1);
  env::Environment environment(id);
  core::Rng rng(1);
  std::set<std::vector<int>> seen;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    environment.reset(seed);
    if (environment.instruction().order != order) continue;
    EXPECT_TRUE(curriculum.prepare(environment, rng));
    const auto c = environment.completion();
    seen.emplace(c.begin(), c.end());
  }
  return seen;
}

TEST(Curriculum, HalfDoneStartsMarkWhatComesFirst) {
  using Starts = std::set<std::vector<int>>;
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::before), (Starts{{1, 0}}));
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::after), (Starts{{0, 1}}));
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::any), (Starts{{1, 0}, {0, 1}}));
}

TEST(Curriculum, HalfDoneStartsLeaveFromOneClauseToAllButOne) {
  using Starts = std::set<std::vector<int>>;
  EXPECT_EQ(starts("Wordgaze-Four-N8-K4-v0", babyai::Order::before),
            (Starts{{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}, {1, 1, 0, 1}}));
}

TEST(Curriculum, LeavesTheEpisodesAloneThatItIsNotToHelp) {
  const Curriculum curriculum = half_done(0);
  env::Environment environment("Wordgaze-Two-N8-K4-v0");
  environment.reset(1);
  const auto instruction = environment.instruction();
  core::Rng rng(1);
  EXPECT_FALSE(curriculum.prepare(environment, rng));
  EXPECT_EQ(environment.instruction(), instruction);
  EXPECT_EQ(std::ranges::count(environment.completion(), 1), 0);
}

}  // namespace
}  // namespace wordgaze::rl
