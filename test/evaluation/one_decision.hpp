#pragma once
#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/policy/environment.hpp"

namespace wordgaze::test {

/// An agent without training in a room, at a decision in the middle of an episode. Its policy is
/// far from even.
struct OneDecision {
  policy::Agent agent;
  policy::Agent::Weights weights;
  policy::Agent::Params& params = weights.params;
  env::Environment environment{"Wordgaze-Two-N8-K4-v0"};
  policy::NetworkPolicy<policy::Agent> policy;
  policy::Observation observation;
  policy::Decision decision;

  explicit OneDecision(bool attention, std::uint64_t seed = 1)
      : agent{config(attention), model::CellAlphabet::one_room()},
        weights(fresh(agent, seed)),
        policy(agent, weights) {
    environment.reset(seed);
  }
  OneDecision(const OneDecision&) = delete;
  OneDecision& operator=(const OneDecision&) = delete;

  /// Decides, after as many steps; the action is the first.
  evaluation::DecisionContext decide(int steps = 0) {
    agent.refresh(weights);
    policy.refresh();
    for (int t = 0; t <= steps; ++t) {
      policy::observe(environment, observation);
      policy.observe(0, observation);
      decision = policy.decide([](int, auto) { return std::size_t{0}; })[0];
      if (t < steps) environment.step(grid::Action::left);
    }
    return {policy, 0, environment, observation, decision};
  }

  /// Leaves the memory blind for all cells but one.
  void see_only(Index cell) {
    const Index channels = agent.config.channels;
    const Matrix<float> kept = params.memory.input_weight.middleCols(cell * channels, channels);
    params.memory.input_weight.setZero();
    params.memory.input_weight.middleCols(cell * channels, channels) = 10 * kept;
  }

  static model::Config config(bool attention) {
    model::Config c;
    c.attention = c.task_attention = attention;
    return c;
  }

 private:
  static policy::Agent::Weights fresh(const policy::Agent& agent, std::uint64_t seed) {
    core::Rng rng(seed);
    auto params = agent.initialize(rng);
    params.actor.output.weight *= 300;
    return agent.make_weights(std::move(params));
  }
};

inline constexpr Index kCellInFront = 3 * grid::kViewSize + 5;

}  // namespace wordgaze::test
