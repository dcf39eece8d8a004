#include "wordgaze/rl/evaluator.hpp"

#include <cmath>
#include <memory>

#include "wordgaze/nn/categorical.hpp"
#include "wordgaze/rl/recorder.hpp"

namespace wordgaze::rl {
namespace {

using Choice = nn::Categorical<float>;

/// Actions depend on the episode alone, not on the lane or the worker that runs it.
core::Rng episode_rng(std::uint64_t seed) { return core::Rng(seed ^ 0x5eed'0000'0000'0000); }

struct Lane {
  env::Environment environment;
  core::Rng rng;
  std::int64_t episode = -1;  // -1: nothing left to do
  double episode_return = 0;
  std::unique_ptr<Recorder> recorder{};
};

/// Episodes [from, to) on one worker.
EvaluationResult run_share(const Agent& agent, const Agent::Params& params,
                           const Agent::Tables& tables, const Evaluation& e, int from, int to,
                           const Audience& audience) {
  const int lane_count = std::min(e.lanes, to - from);
  EvaluationResult result;
  if (lane_count <= 0) return result;
  Actor actor(agent, lane_count);
  std::vector<Lane> lanes;
  const env::Environment blank(e.level);
  int next = from, running = 0;
  const auto start = [&](int b) {
    Lane& lane = lanes[static_cast<std::size_t>(b)];
    lane.episode = next < to ? next++ : -1;
    if (lane.episode < 0) return;
    ++running;
    const std::uint64_t seed = e.seed + static_cast<std::uint64_t>(lane.episode);
    lane.environment.reset(seed);
    lane.rng = episode_rng(seed);
    lane.episode_return = 0;
    actor.begin(b, lane.environment.sentence());
    if (audience.observer == nullptr) return;
    lane.recorder = std::make_unique<Recorder>(*audience.observer);
    if (!lane.recorder->begin(lane.episode, b, seed, lane.environment)) lane.recorder.reset();
  };
  for (int b = 0; b < lane_count; ++b) {
    lanes.push_back({blank, core::Rng()});
    start(b);
  }
  while (running > 0) {
    for (int b = 0; b < lane_count; ++b) {
      actor.observe(b, lanes[static_cast<std::size_t>(b)].environment);
    }
    actor.decide(params, tables);
    actor.advance();
    for (int b = 0; b < lane_count; ++b) {
      Lane& lane = lanes[static_cast<std::size_t>(b)];
      if (lane.episode < 0) continue;
      std::array<float, grid::kActions> log_p;
      Choice::log_softmax({actor.cache().logits().col(b).data(), grid::kActions}, log_p);
      const auto action = e.greedy ? Choice::greedy(log_p)
                                   : Choice::sample(log_p, static_cast<float>(lane.rng.uniform()));
      result.hits.add(agent, actor, b, lane.environment);
      if (audience.witness != nullptr) {
        audience.witness->on_decision({actor, b, lane.environment, action});
      }
      if (lane.recorder) {
        lane.recorder->decide(agent, actor, b, lane.environment, static_cast<int>(action),
                              Choice::entropy(log_p));
      }
      const auto transition = lane.environment.step(static_cast<grid::Action>(action));
      lane.episode_return += transition.reward;
      if (lane.recorder) lane.recorder->step(transition);
      if (!transition.terminated && !transition.truncated) continue;

      const bool success = transition.terminated && transition.reward > 0;
      ++result.episodes;
      result.successes += success;
      result.done_wrong += transition.terminated && !success;
      result.truncated += !transition.terminated;
      result.return_sum += lane.episode_return;
      result.steps += lane.environment.step_count();
      result.breakdown.add(lane.environment.instruction(), success);
      if (lane.recorder) {
        lane.recorder->end({.episode = lane.episode,
                            .lane = b,
                            .steps = lane.environment.step_count(),
                            .episode_return = lane.episode_return,
                            .success = success,
                            .truncated = !transition.terminated});
      }
      --running;
      start(b);
    }
  }
  return result;
}

}  // namespace

void EvaluationResult::operator+=(const EvaluationResult& o) {
  episodes += o.episodes;
  successes += o.successes;
  done_wrong += o.done_wrong;
  truncated += o.truncated;
  return_sum += o.return_sum;
  steps += o.steps;
  hits += o.hits;
  breakdown += o.breakdown;
}

Interval wilson_interval(int successes, int episodes) {
  if (episodes == 0) return {0, 1};
  constexpr double z = 1.959963984540054;
  const double n = episodes, p = successes / n;
  const double center = p + z * z / (2 * n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 / (1 + z * z / n);
  // At the ends the bounds are 0 and 1, not what rounding makes of them.
  return {successes == 0 ? 0 : (center - half) * scale,
          successes == episodes ? 1 : (center + half) * scale};
}

EvaluationResult evaluate(const Agent& agent, const Agent::Params& params,
                          const Evaluation& evaluation, Team& team, Audience audience) {
  Agent::Tables tables = agent.make_tables();
  agent.update_all_tables(params, tables);
  if (!audience.empty()) {
    return run_share(agent, params, tables, evaluation, 0, evaluation.episodes, audience);
  }
  std::vector<EvaluationResult> parts(static_cast<std::size_t>(team.size()));
  team.run([&](int w) {
    const auto [from, to] = team.share(evaluation.episodes, w);
    parts[static_cast<std::size_t>(w)] = run_share(agent, params, tables, evaluation, from, to, {});
  });
  EvaluationResult result;
  for (const auto& part : parts) result += part;
  return result;
}

GazeHits probe_gaze(const Agent& agent, const Agent::Params& params, const Agent::Tables& tables,
                    const babyai::LevelSpec& level, int lanes, int steps, std::uint64_t seed) {
  Actor actor(agent, lanes);
  core::Rng rng = episode_rng(seed);
  std::vector<env::Environment> environments;
  for (int b = 0; b < lanes; ++b) {
    environments.emplace_back(level);
    environments.back().reset(seed + static_cast<std::uint64_t>(b));
    actor.begin(b, environments.back().sentence());
  }
  GazeHits hits;
  for (int t = 0; t < steps; ++t) {
    for (int b = 0; b < lanes; ++b) actor.observe(b, environments[static_cast<std::size_t>(b)]);
    actor.decide(params, tables);
    actor.advance();
    for (int b = 0; b < lanes; ++b) {
      auto& environment = environments[static_cast<std::size_t>(b)];
      std::array<float, grid::kActions> log_p;
      Choice::log_softmax({actor.cache().logits().col(b).data(), grid::kActions}, log_p);
      hits.add(agent, actor, b, environment);
      const auto action = Choice::sample(log_p, static_cast<float>(rng.uniform()));
      const auto transition = environment.step(static_cast<grid::Action>(action));
      if (transition.terminated || transition.truncated) {
        environment.reset();
        actor.begin(b, environment.sentence());
      }
    }
  }
  return hits;
}

}  // namespace wordgaze::rl
