#pragma once
#include <cstdint>
#include <functional>
#include <memory>

#include "wordgaze/core/team.hpp"
#include "wordgaze/env/policy.hpp"
#include "wordgaze/evaluation/breakdown.hpp"
#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/evaluation/pointing.hpp"
#include "wordgaze/policy/network_policy.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::evaluation {

/// What to measure: episode k runs in the world of seed `seed` + k.
struct Evaluation {
  babyai::LevelSpec level;
  int episodes = 1000;
  std::uint64_t seed = 1'000'000;
  bool greedy = false;
  int lanes = 64;          ///< of each worker
  std::int64_t first = 0;  ///< number of episode 0, as observers are told
  /// Called by all workers now and then, if there is one; what it throws ends the evaluation.
  std::function<void()> between_steps{};
};

struct EvaluationResult {
  int episodes = 0, successes = 0;
  int done_wrong = 0;  ///< ended by a failure, such as declaring what was not done
  int truncated = 0;
  double return_sum = 0;
  std::int64_t steps = 0;
  Pointing pointing;  ///< of M; empty without attention
  Breakdown breakdown;

  double success_rate() const { return ratio(successes); }
  double mean_reward() const { return ratio(return_sum); }
  double mean_steps() const { return ratio(static_cast<double>(steps)); }
  void operator+=(const EvaluationResult& o);

 private:
  double ratio(double sum) const { return episodes > 0 ? sum / episodes : 0; }
};

/// 95 % interval of a success rate (Wilson's score interval).
struct Interval {
  double low, high;
};
Interval wilson_interval(int successes, int episodes);

/// Makes a policy of some lanes; each worker has one of its own.
using PolicyFactory = std::function<std::unique_ptr<policy::Policy>(int lanes)>;

/// Of a network; both must outlive the factory.
template <class Agent>
PolicyFactory policy_factory(const Agent& agent, const typename Agent::Weights& weights) {
  return [&](int lanes) {
    return std::make_unique<policy::NetworkPolicy<Agent>>(agent, weights, lanes);
  };
}
template <class Agent>
PolicyFactory policy_factory(const policy::BasicTrainedAgent<Agent>& trained) {
  return policy_factory(trained.agent, trained.weights);
}

/// Who is told of an evaluation.
struct Observers {
  policy::Observer* episodes = nullptr;   ///< is told of the episodes that it wants
  DecisionObserver* decisions = nullptr;  ///< looks into every decision

  bool empty() const { return episodes == nullptr && decisions == nullptr; }
};

/// Runs the episodes, shared out to the team; with observers on one worker, in order of their
/// beginning.
EvaluationResult evaluate(const PolicyFactory& make_policy, const Evaluation& evaluation,
                          Team& team, const Observers& observers = {});

/// The same for a policy that sees the environment itself, as the bot does.
EvaluationResult evaluate(const env::PolicyMaker& make_policy, const Evaluation& evaluation,
                          Team& team);

/// How well M finds the target in worlds of a level, one a lane, over the first `steps` steps.
Pointing probe_gaze(policy::Policy& policy, const babyai::LevelSpec& level, int steps,
                    std::uint64_t seed);

}  // namespace wordgaze::evaluation
