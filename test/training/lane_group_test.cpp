#include "wordgaze/training/lane_group.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/messages.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/training/batch.hpp"
#include "wordgaze/training/trainer.hpp"

/// What a rollout holds, against the network asked once more about the same experience.
namespace wordgaze::training {
namespace {

using policy::Agent;

TrainConfig one_clause() {
  TrainConfig c;
  c.env = "Wordgaze-One-N6-K2-v0";
  c.ppo.lanes = 6;
  c.ppo.steps = 12;
  c.ppo.chunk = 4;
  c.model.memory_size = 8;
  c.curriculum = {.pickup_first = false, .balance = false, .stretch = 0, .huddle = 0};
  return c;
}

/// The mask reads what is done, and the text is read through the mask.
TrainConfig two_clauses() {
  TrainConfig c = one_clause();
  c.env = "Wordgaze-Two-N6-K3-v0";
  c.model.task_attention = true;
  c.curriculum.half_done_start = c.curriculum.half_done_end = 0.7;
  return c;
}

TrainConfig told_what_is_done() {
  TrainConfig c = two_clauses();
  c.model.task_attention = false;
  c.model.completion_input = true;
  return c;
}

/// An agent whose decisions depend on all that it sees and remembers, in episodes that time ends.
struct Collected {
  TrainConfig config;
  babyai::LevelSpec level;
  Agent agent;
  Agent::Weights weights;
  Curriculum curriculum;
  LaneGroup group;
  Rollout rollout;

  explicit Collected(const TrainConfig& c)
      : config(c),
        level(short_episodes(c.env)),
        agent(c.model, policy::alphabet_of(level)),
        weights(agent.make_weights(lively(agent))),
        curriculum(c.curriculum),
        group(make_policy(c.ppo.lanes), config, level, 0),
        rollout(c.model, c.ppo) {}

  static babyai::LevelSpec short_episodes(const std::string& id) {
    auto level = babyai::find_level(id);
    level.max_steps = 5;
    return level;
  }
  static Agent::Params lively(const Agent& agent) {
    core::Rng rng(3);
    auto params = agent.initialize(rng);
    params.actor.output.weight *= 100;
    if (params.completion.size() > 0) nn::fill_uniform(params.completion, 1, rng);
    return params;
  }
  std::unique_ptr<policy::Policy> make_policy(int lanes) const {
    return std::make_unique<policy::NetworkPolicy<Agent>>(agent, weights, lanes);
  }
  void collect() { group.collect(curriculum, rollout, nullptr); }
};

struct LaneGroupVariant : testing::TestWithParam<TrainConfig> {
  Collected c{GetParam()};
};

TEST_P(LaneGroupVariant, TheLearnerSeesWhatTheAgentSaw) {
  for (int k = 0; k < 3; ++k) c.collect();  // from the second on, lanes begin amid an episode
  const Rollout& r = c.rollout;
  estimate_advantages(r.shape, r.reward, r.value, r.ended, r.next_value, 0.99f, 0.95f,
                      c.rollout.advantage);
  EXPECT_TRUE(first_not_finite(r).empty());
  Batch batch;
  std::vector<int> sequences;
  for (int s = 0; s < r.sequences(); ++s) sequences.push_back(s);
  batch.gather(c.config.model, r, sequences, {});
  Matrix<float> text(model::mission_features(c.config.model), batch.missions.size());
  Agent::Cache cache;
  model::Outputs<float> out;
  c.agent.encode_text(c.weights, batch.missions, cache, text);
  c.agent.forward(c.weights, batch.frames, batch.missions, text, cache, out);
  int ends = 0;
  for (int s : sequences) {
    for (Index t = 0; t < r.chunk; ++t) {
      const Index ours = batch.frames.shape.column(t, s);
      const auto n = static_cast<std::size_t>(r.column(s, t)), i = static_cast<std::size_t>(ours);
      std::array<float, grid::kActions> log_p;
      nn::Categorical<float>::log_softmax({out.logits.col(ours).data(), grid::kActions}, log_p);
      EXPECT_NEAR(log_p[r.action[n]], r.log_prob[n], 1e-4) << "sequence " << s << ", step " << t;
      EXPECT_NEAR(out.values(0, ours), r.value[n], 1e-4) << "sequence " << s << ", step " << t;
      EXPECT_EQ(batch.value_target[i], r.advantage[n] + r.value[n]);
      ends += r.ended[n];
    }
  }
  EXPECT_GT(ends, c.config.ppo.lanes);
  // All that the agent lives on is there to be forgotten.
  EXPECT_GT(r.start_h.cwiseAbs().minCoeff(), 0);
  if (c.config.curriculum.half_done_start > 0) {
    EXPECT_GT(r.completion.sum(), 0);
  }
}

TEST_P(LaneGroupVariant, WhatTimeCutsOffIsWorthWhatTheAgentWouldHaveExpected) {
  c.collect();
  std::vector<LaneGroup::LaneState> before;
  for (int b = 0; b < c.config.ppo.lanes; ++b) before.push_back(c.group.state(b));
  c.collect();
  int cuts = 0;
  for (int b = 0; b < c.config.ppo.lanes; ++b) {
    const auto& state = before[static_cast<std::size_t>(b)];
    env::Environment world(c.level);
    world.restore(state.environment);
    const auto again = c.make_policy(1);
    again->begin(0);
    again->set_memory(0, state.memory);
    for (Index t = 0; t < c.rollout.shape.steps; ++t) {
      const auto n = static_cast<std::size_t>(c.rollout.shape.column(t, b));
      again->observe(0, policy::observe(world));
      again->decide([&](int, std::span<const float>) { return c.rollout.action[n]; });
      const auto transition = world.step(static_cast<grid::Action>(c.rollout.action[n]));
      double reward = transition.reward;
      if (transition.truncated && !transition.terminated) {
        again->observe(0, policy::observe(world));
        reward += c.config.ppo.discount * static_cast<double>(again->values()[0]);
        ++cuts;
      }
      EXPECT_NEAR(c.rollout.reward[n], reward, 1e-4) << "lane " << b << ", step " << t;
      EXPECT_EQ(c.rollout.ended[n] != 0, transition.terminated || transition.truncated);
      if (c.rollout.ended[n]) break;  // the next world is another
    }
  }
  EXPECT_GT(cuts, 0);
}

TEST_P(LaneGroupVariant, ExpectsWhatTheNextRolloutBeginsWith) {
  c.collect();
  const auto expected = c.rollout.next_value;
  c.collect();
  for (std::size_t b = 0; b < expected.size(); ++b) {
    EXPECT_NEAR(expected[b], c.rollout.value[b], 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, LaneGroupVariant,
                         testing::Values(one_clause(), two_clauses(), told_what_is_done()),
                         [](const auto& c) {
                           return std::string(c.param.model.task_attention     ? "TwoClauses"
                                              : c.param.model.completion_input ? "ToldWhatIsDone"
                                                                               : "OneClause");
                         });

TEST(LaneGroup, AMemoryThatIsNotFiniteIsNamed) {
  Collected c(one_clause());
  c.collect();
  LaneGroup::LaneState state = c.group.state(2);
  state.memory.c(1) = std::numeric_limits<float>::infinity();
  const auto refused = message_of<std::runtime_error>([&] { c.group.restore(2, state); });
  EXPECT_TRUE(contains(refused, "lane 2"));
  EXPECT_TRUE(contains(refused, "lanes.c"));
  // And where it arises.
  c.weights.params.memory.hidden_weight.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { c.collect(); }), "memory of lane 0"));
}

}  // namespace
}  // namespace wordgaze::training
