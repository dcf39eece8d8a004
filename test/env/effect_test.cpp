#include "wordgaze/env/effect.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <stdexcept>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/env/random_policy.hpp"

namespace wordgaze::env {
namespace {

using grid::Action;

bool effective(const Environment& env, Action action) {
  return effective_actions(env)[static_cast<std::size_t>(action)];
}

TEST(EffectiveActions, FollowWhatIsInFrontAndInHand) {
  Environment env("MiniGrid-DoorKey-5x5-v0");
  RandomPolicy policy(env.id(), 2);
  env.reset(2);
  for (int n = 0; n < 400; ++n) {
    const grid::World& world = env.world();
    const grid::Object& front = world.object_at(world.front());
    const bool empty_hand = world.carried == grid::kNothing;
    EXPECT_TRUE(effective(env, Action::left));
    EXPECT_TRUE(effective(env, Action::right));
    EXPECT_EQ(effective(env, Action::forward), grid::can_be_entered(front));
    EXPECT_EQ(effective(env, Action::pickup), grid::can_be_carried(front) && empty_hand);
    EXPECT_EQ(effective(env, Action::drop), front.type == grid::Type::empty && !empty_hand);
    EXPECT_EQ(
        effective(env, Action::toggle),
        front.type == grid::Type::door && (front.state != grid::DoorState::locked || !empty_hand));
    EXPECT_FALSE(effective(env, Action::done));
    const Transition transition = env.step(policy(env));
    if (transition.terminated || transition.truncated) env.reset();
  }
}

TEST(EffectiveActions, HoldDoneWhereItCounts) {
  Environment env("MiniGrid-GoToObject-6x6-N2-v0");
  RandomPolicy policy(env.id(), 1);
  env.reset(1);
  int declared = 0;
  for (int n = 0; n < 2000; ++n) {
    Environment trial = env;
    const bool ends = trial.step(Action::done).terminated;
    EXPECT_EQ(effective(env, Action::done), ends);
    declared += ends;
    const Transition transition = env.step(policy(env));
    if (transition.terminated || transition.truncated) env.reset();
  }
  EXPECT_GT(declared, 0);
}

TEST(EffectiveActions, AreNoneThatTheLevelDoesNotHave) {
  Environment env("MiniGrid-Dynamic-Obstacles-6x6-v0");
  env.reset(0);
  EXPECT_EQ(effective_actions(env), (std::array{true, true, true, false, false, false, false}));
}

TEST(EffectiveActions, DoNotTakeTheEndOfTheTimeForAnEffect) {
  babyai::LevelSpec level = babyai::find_level("MiniGrid-Empty-5x5-v0");
  level.max_steps = 1;
  Environment env(level);
  env.reset(0);
  EXPECT_FALSE(effective(env, Action::drop));
  EXPECT_TRUE(effective(env, Action::forward));
}

TEST(EffectiveActions, LeaveTheEnvironmentAsItWas) {
  Environment env("BabyAI-BossLevel-v0");
  env.reset(4);
  const auto before = env.serialize();
  effective_actions(env);
  EXPECT_EQ(env.serialize(), before);
  EXPECT_THROW(effective_actions(Environment("BabyAI-BossLevel-v0")), std::logic_error);
}

}  // namespace
}  // namespace wordgaze::env
