#pragma once
#include "wordgaze/model/initialize.hpp"
#include "wordgaze/rl/witness.hpp"

namespace wordgaze::test {

/// An agent without training in a room, at a decision in the middle of an episode. Its policy is
/// far from even.
struct OneDecision {
  rl::Agent agent;
  rl::Agent::Params params;
  env::Environment environment{"Wordgaze-Two-N8-K4-v0"};
  rl::Actor actor;

  explicit OneDecision(bool attention, std::uint64_t seed = 1)
      : agent{config(attention), model::CellAlphabet::one_room()}, actor(agent, 1) {
    core::Rng rng(seed);
    params = model::initialize(agent, rng);
    params.actor.output.weight *= 300;
    environment.reset(seed);
    actor.begin(0, environment.sentence());
  }

  /// Decides, after as many steps; the action is the first.
  rl::Decision decide(int steps = 0) {
    auto tables = agent.make_tables();
    agent.update_all_tables(params, tables);
    for (int t = 0; t <= steps; ++t) {
      actor.observe(0, environment);
      actor.decide(params, tables);
      actor.advance();
      if (t < steps) environment.step(grid::Action::left);
    }
    return {actor, 0, environment, 0};
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
};

inline constexpr Index kCellInFront = 3 * grid::kViewSize + 5;

}  // namespace wordgaze::test
