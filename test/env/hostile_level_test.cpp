#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <variant>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/env/random_policy.hpp"

// Whatever numbers a level has: they are refused when the environment is made, or it plays. Run
// with the preset asan, this shows that nothing is read or written out of bounds.
namespace wordgaze::babyai {
void PrintTo(const LevelSpec& level, std::ostream* out) { *out << level.id; }
}  // namespace wordgaze::babyai

namespace wordgaze::env {
namespace {

using babyai::LevelSpec;

int small(core::Rng& rng) { return static_cast<int>(rng.integer(-1, 27)); }

struct AnyNumbers {
  core::Rng& rng;

  void operator()(std::monostate&) const {}
  void operator()(babyai::Objects& p) const { p = {small(rng), rng.below(2) == 0}; }
  void operator()(babyai::OneRoomTask& p) const { p = {small(rng), small(rng) % 6}; }
  void operator()(babyai::Missions& p) const {
    p.objects = small(rng);
    p.locked_room = rng.below(3) * 0.5;
    p.verbs.resize(static_cast<std::size_t>(rng.below(5)));
    p.forms.resize(static_cast<std::size_t>(rng.below(4)));
  }
  void operator()(babyai::Doors& p) const { p.count = small(rng); }
  void operator()(babyai::Crossings& p) const { p.rivers = small(rng); }
  void operator()(babyai::MultiRoom& p) const { p = {small(rng) % 8, small(rng)}; }
  void operator()(babyai::Obstacles& p) const { p.count = small(rng); }
  void operator()(babyai::ObstructedDoor&) const {}
  void operator()(babyai::Plan&) const {}  // of level files: PlannedLevel, LevelText
  void operator()(babyai::Maze& p) const {
    p.agent_column = small(rng) % 5;
    p.agent_row = small(rng) % 5;
    p.quarters = small(rng) % 6;
  }
};

LevelSpec with_other_numbers(LevelSpec level, core::Rng& rng) {
  if (rng.below(2) == 0) level.room_size = small(rng);
  if (rng.below(2) == 0) level.rows = small(rng) % 8;
  if (rng.below(2) == 0) level.columns = small(rng) % 8;
  if (rng.below(2) == 0) std::visit(AnyNumbers{rng}, level.parameters);
  return level;
}

class HostileLevel : public testing::TestWithParam<LevelSpec> {};

TEST_P(HostileLevel, IsRefusedOrPlays) {
  constexpr int kLevels = 60, kSteps = 60;
  core::Rng rng(17);
  int refused = 0, played = 0;
  for (int n = 0; n < kLevels; ++n) {
    const LevelSpec level = with_other_numbers(GetParam(), rng);
    std::optional<Environment> env;
    try {
      env.emplace(level);
    } catch (const std::invalid_argument&) {
      ++refused;
      continue;
    }
    ASSERT_NO_THROW(env->reset(1))
        << level.id << ": " << level.columns << " x " << level.rows << " of " << level.room_size;
    ++played;
    RandomPolicy policy(level.id, 1);
    for (int k = 0; k < kSteps; ++k) {
      const Transition t = env->step(policy(*env));
      if (t.terminated || t.truncated) break;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(played, 0);
}

INSTANTIATE_TEST_SUITE_P(, HostileLevel,
                         testing::ValuesIn(babyai::built_in_levels().begin(),
                                           babyai::built_in_levels().end()),
                         [](const auto& test) {
                           std::string name = test.param.id;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace wordgaze::env
