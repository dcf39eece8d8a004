#include "wordgaze/rl/actor.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace wordgaze::policy {
namespace {

Agent agent_with(int clauses, bool task_attention) {
  model::Config config;
  config.clauses = clauses;
  config.task_attention = task_attention;
  return {config, model::CellAlphabet::one_room()};
}

TEST(Actor, TellsTheAgentWhatIsInItsHand) {
  env::Environment environment("BabyAI-PutNextLocal-v0");
  environment.reset(3);
  const Agent agent = agent_with(4, true);
  Actor actor(agent, 1);
  actor.begin(0, environment.sentence());
  actor.observe(0, environment);
  EXPECT_EQ(actor.frames().completion.sum(), 0);
  environment.take_object(
      static_cast<grid::ObjectId>(std::countr_zero(environment.meaning().object[0])));
  actor.observe(0, environment);
  EXPECT_EQ(actor.frames().completion(0, 0), 1);
  EXPECT_EQ(actor.frames().completion.sum(), 1);
}

TEST(Actor, RefusesMoreSubTasksThanItsCompletionVectorHolds) {
  env::Environment environment("BabyAI-PutNextLocal-v0");
  environment.reset(3);
  const Agent small = agent_with(1, true), large = agent_with(2, true),
              blind = agent_with(1, false);
  EXPECT_THROW(Actor(small, 1).begin(0, environment.sentence()), std::invalid_argument);
  EXPECT_NO_THROW(Actor(large, 1).begin(0, environment.sentence()));
  EXPECT_NO_THROW(Actor(blind, 1).begin(0, environment.sentence()));  // it reads no c_t
}

}  // namespace
}  // namespace wordgaze::policy
