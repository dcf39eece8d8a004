#include "wordgaze/evaluation/evaluator.hpp"

#include <gtest/gtest.h>

#include "evaluation/one_decision.hpp"
#include "wordgaze/bot/policy.hpp"

namespace wordgaze::evaluation {
namespace {

TEST(WilsonInterval, MatchesPublishedValues) {
  const auto half = wilson_interval(50, 100);
  EXPECT_NEAR(half.low, 0.4038, 5e-5);
  EXPECT_NEAR(half.high, 0.5962, 5e-5);
  const auto all = wilson_interval(100, 100);
  EXPECT_NEAR(all.low, 0.9630, 5e-5);
  EXPECT_EQ(all.high, 1);
  EXPECT_EQ(wilson_interval(0, 100).low, 0);
}

TEST(Evaluation, OfTheBotIsTheSameOnAnyNumberOfWorkers) {
  const Evaluation evaluation{.level = babyai::find_level("BabyAI-GoToLocal-v0"), .episodes = 40};
  Team one(1), three(3);
  const auto a = evaluate(bot::policy_maker("bot"), evaluation, one);
  const auto b = evaluate(bot::policy_maker("bot"), evaluation, three);
  EXPECT_EQ(a.successes, 40);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_NEAR(a.return_sum, b.return_sum, 1e-9);
  const auto random = evaluate(bot::policy_maker("random"), evaluation, one);
  EXPECT_LT(random.mean_reward(), a.mean_reward());
  EXPECT_EQ(random.episodes, random.successes + random.done_wrong + random.truncated);
}

TEST(Pointing, OfAPolicyCountsDoorsInAnyState) {
  // A mission about a closed door: the door in view is a target, whatever its state.
  env::Environment environment("BabyAI-OpenDoor-v0");
  const policy::Agent agent(model::Config{}, model::CellAlphabet::everything());
  core::Rng rng(1);
  const auto weights = agent.make_weights(agent.initialize(rng));
  policy::NetworkPolicy<policy::Agent> policy(agent, weights);
  Pointing pointing;
  for (int seed = 0; seed < 30; ++seed) {
    environment.reset(seed);
    for (int turn = 0; turn < 4; ++turn) {
      const auto observation = policy::observe(environment);
      policy.observe(0, observation);
      policy.decide(policy::Greedy{});
      pointing.add(policy, 0, observation.image, environment.progress());
      environment.step(grid::Action::left);
    }
  }
  EXPECT_GT(pointing.target.count, 20);
}

}  // namespace
}  // namespace wordgaze::evaluation
