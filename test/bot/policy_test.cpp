#include "wordgaze/bot/policy.hpp"

#include <gtest/gtest.h>

namespace wordgaze::bot {
namespace {

using grid::Action;

// The successes among the episodes of a number of steps.
int successes(std::string_view id, const env::PolicyMaker& make, int steps) {
  env::Environment env(id);
  env.reset(3);
  const env::Policy policy = make(id, 3, 0);
  int count = 0;
  for (int n = 0; n < steps; ++n) {
    const env::Transition transition = env.step(policy(env));
    count += transition.reward > 0;
    if (transition.terminated || transition.truncated) env.reset();
  }
  return count;
}

TEST(BotPolicy, SolvesOneEpisodeAfterTheOther) {
  const std::string_view id = "BabyAI-GoToSeqS5R2-v0";
  EXPECT_GT(successes(id, policy_maker("bot"), 500),
            2 * successes(id, policy_maker("random"), 500));
}

TEST(BotPolicy, DeclaresWhatItHasDone) {
  EXPECT_GT(successes("Wordgaze-One-N8-K4-v0", policy_maker("bot"), 500), 20);
}

// The bot hears of a pickup that is declared by the next action, and goes on with the next clause.
TEST(BotPolicy, GoesOnAfterWhatItHasDeclared) {
  EXPECT_GT(successes("Wordgaze-Two-N8-K4-v0", policy_maker("bot"), 1000), 20);
  EXPECT_GT(successes("Wordgaze-Six-N8-K8-v0", policy_maker("bot"), 2000), 5);
}

TEST(BotPolicy, ActsAtRandomWhereThereIsNoInstruction) {
  const std::string_view id = "MiniGrid-DoorKey-5x5-v0";
  env::Environment env(id);
  env.reset(0);
  const env::Policy bot = policy_maker("bot")(id, 0, 0), random = policy_maker("random")(id, 0, 0);
  for (int n = 0; n < 50; ++n) {
    const Action action = bot(env);
    EXPECT_EQ(action, random(env));
    env.step(action);
  }
}

TEST(BotPolicy, ActsAtRandomWhenTheBotGivesUp) {
  const std::string_view id = "BabyAI-KeyInBox-v0";
  env::Environment env(id);
  env.reset(0);
  const env::Policy policy = policy_maker("bot")(id, 0, 0);
  Bot bot(env);
  while (const auto action = bot.next(env)) {
    ASSERT_EQ(policy(env), *action);
    env.step(*action);
  }
  env::RandomPolicy random(id, 0, 0);
  for (int n = 0; n < 50; ++n) {
    const Action action = policy(env);
    ASSERT_EQ(action, random(env));
    env.step(action);
  }
}

TEST(BotPolicy, MixedIsTheBotForEvenSeeds) {
  const std::string_view id = "BabyAI-GoToLocal-v0";
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    env::Environment env(id);
    env.reset(seed);
    const env::Policy mixed = policy_maker("mixed")(id, seed, 9);
    const env::Policy expected = policy_maker(seed % 2 == 0 ? "bot" : "random")(id, seed, 9);
    for (int n = 0; n < 30; ++n) {
      const Action action = mixed(env);
      EXPECT_EQ(action, expected(env));
      if (env.step(action).terminated) env.reset();
    }
  }
}

TEST(BotPolicy, RefusesAnUnknownName) {
  EXPECT_THROW(policy_maker("clever"), std::invalid_argument);
}

}  // namespace
}  // namespace wordgaze::bot
