#include "wordgaze/evaluation/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "wordgaze/evaluation/episode.hpp"

namespace wordgaze::evaluation {
namespace {

/// Actions depend on the episode alone, not on the lane or the worker that runs it.
core::Rng episode_rng(std::uint64_t seed) { return core::Rng(seed ^ 0x5eed'0000'0000'0000); }

/// What is counted of an episode.
void count(const Outcome& outcome, const babyai::Instruction& instruction,
           EvaluationResult& result) {
  ++result.episodes;
  result.successes += outcome.success;
  result.done_wrong += !outcome.truncated && !outcome.success;
  result.truncated += outcome.truncated;
  result.return_sum += outcome.episode_return;
  result.steps += outcome.steps;
  result.breakdown.add(instruction, outcome.success);
}

struct Lane {
  Episode episode;
  core::Rng rng{};
  bool running = false;
};

/// Episodes [from, to) on one worker.
EvaluationResult run_share(const PolicyFactory& make_policy, const Evaluation& e, int from, int to,
                           const Observers& observers) {
  const int lane_count = std::min(e.lanes, to - from);
  EvaluationResult result;
  if (lane_count <= 0) return result;
  const auto policy = make_policy(lane_count);
  const env::Environment blank(e.level);
  std::vector<Lane> lanes;
  for (int b = 0; b < lane_count; ++b) lanes.push_back({Episode(blank)});
  int next = from, running = 0;
  const auto start = [&](int b) {
    Lane& lane = lanes[static_cast<std::size_t>(b)];
    lane.running = next < to;
    if (!lane.running) return;
    ++running;
    const std::uint64_t seed = e.seed + static_cast<std::uint64_t>(next);
    lane.episode.environment.reset(seed);
    lane.rng = episode_rng(seed);
    lane.episode.begin(*policy, b);
    if (observers.episodes != nullptr) {
      lane.episode.report(*observers.episodes, {.number = e.first + next, .lane = b, .seed = seed});
    }
    ++next;
  };
  const auto sampler = [&](int b, std::span<const float> log_probs) {
    Lane& lane = lanes[static_cast<std::size_t>(b)];
    return e.greedy ? policy::Greedy{}(b, log_probs) : policy::Sampled{lane.rng}(b, log_probs);
  };
  for (int b = 0; b < lane_count; ++b) start(b);
  while (running > 0) {
    if (e.between_steps) e.between_steps();
    for (int b = 0; b < lane_count; ++b) {
      Lane& lane = lanes[static_cast<std::size_t>(b)];
      if (!lane.running) continue;
      lane.episode.observe();
      policy->observe(b, lane.episode.observation);
    }
    const auto decisions = policy->decide(sampler);
    for (int b = 0; b < lane_count; ++b) {
      Lane& lane = lanes[static_cast<std::size_t>(b)];
      if (!lane.running) continue;
      Episode& episode = lane.episode;
      const auto& decision = decisions[static_cast<std::size_t>(b)];
      result.pointing.add(*policy, b, episode.observation.image, episode.environment.progress());
      if (observers.decisions != nullptr) {
        observers.decisions->on_decision(
            {*policy, b, episode.environment, episode.observation, decision});
      }
      if (!episode.step(*policy, b, decision).ended()) continue;
      count(episode.outcome(), episode.environment.instruction(), result);
      --running;
      start(b);
    }
  }
  return result;
}

EvaluationResult run_share(const env::PolicyMaker& make_policy, const Evaluation& e, int from,
                           int to) {
  EvaluationResult result;
  env::Environment environment(e.level);
  for (int k = from; k < to; ++k) {
    const std::uint64_t seed = e.seed + static_cast<std::uint64_t>(k);
    const env::Policy policy = make_policy(environment.id(), seed, 0);
    environment.reset(seed);
    Outcome outcome;
    for (env::Transition now; !now.terminated && !now.truncated;) {
      if (e.between_steps) e.between_steps();
      now = environment.step(policy(environment));
      outcome.episode_return += now.reward;
      outcome.success = now.terminated && now.reward > 0;
      outcome.truncated = !now.terminated;
    }
    outcome.steps = environment.step_count();
    count(outcome, environment.instruction(), result);
  }
  return result;
}

/// The sum over the team of run(from, to).
template <class Run>
EvaluationResult run_shares(int episodes, Team& team, Run&& run) {
  std::vector<EvaluationResult> parts(static_cast<std::size_t>(team.size()));
  team.run([&](int w) {
    const auto [from, to] = team.share(episodes, w);
    parts[static_cast<std::size_t>(w)] = run(from, to);
  });
  EvaluationResult result;
  for (const auto& part : parts) result += part;
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
  pointing += o.pointing;
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

EvaluationResult evaluate(const PolicyFactory& make_policy, const Evaluation& evaluation,
                          Team& team, const Observers& observers) {
  if (!observers.empty()) {
    return run_share(make_policy, evaluation, 0, evaluation.episodes, observers);
  }
  return run_shares(evaluation.episodes, team, [&](int from, int to) {
    return run_share(make_policy, evaluation, from, to, {});
  });
}

EvaluationResult evaluate(const env::PolicyMaker& make_policy, const Evaluation& evaluation,
                          Team& team) {
  return run_shares(evaluation.episodes, team,
                    [&](int from, int to) { return run_share(make_policy, evaluation, from, to); });
}

Pointing probe_gaze(policy::Policy& policy, const babyai::LevelSpec& level, int steps,
                    std::uint64_t seed) {
  core::Rng rng = episode_rng(seed);
  std::vector<Episode> episodes;
  for (int b = 0; b < policy.lanes(); ++b) {
    Episode& episode = episodes.emplace_back(env::Environment(level));
    episode.environment.reset(seed + static_cast<std::uint64_t>(b));
    episode.begin(policy, b);
  }
  Pointing pointing;
  for (int t = 0; t < steps; ++t) {
    for (int b = 0; b < policy.lanes(); ++b) {
      Episode& episode = episodes[static_cast<std::size_t>(b)];
      episode.observe();
      policy.observe(b, episode.observation);
    }
    const auto decisions = policy.decide(policy::Sampled{rng});
    for (int b = 0; b < policy.lanes(); ++b) {
      Episode& episode = episodes[static_cast<std::size_t>(b)];
      pointing.add(policy, b, episode.observation.image, episode.environment.progress());
      if (!episode.step(policy, b, decisions[static_cast<std::size_t>(b)]).ended()) continue;
      episode.environment.reset();
      episode.begin(policy, b);
    }
  }
  return pointing;
}

}  // namespace wordgaze::evaluation
