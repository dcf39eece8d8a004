#pragma once
#include <vector>

#include "wordgaze/core/team.hpp"
#include "wordgaze/rl/actor.hpp"
#include "wordgaze/rl/breakdown.hpp"
#include "wordgaze/rl/gaze_hits.hpp"
#include "wordgaze/rl/observer.hpp"
#include "wordgaze/rl/witness.hpp"

namespace wordgaze::rl {

/// What to measure: episode k runs in the world of seed `seed` + k.
struct Evaluation {
  babyai::LevelSpec level;
  int episodes = 1000;
  std::uint64_t seed = 1'000'000;
  bool greedy = false;
  int lanes = 64;  ///< of each worker
};

struct EvaluationResult {
  int episodes = 0, successes = 0;
  int done_wrong = 0;  ///< ended by a failure, such as declaring what was not done
  int truncated = 0;
  double return_sum = 0;
  std::int64_t steps = 0;
  GazeHits hits;
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

/// Who attends an evaluation.
struct Audience {
  Observer* observer = nullptr;  ///< is told of the episodes that it wants
  Witness* witness = nullptr;    ///< looks into every decision

  bool empty() const { return observer == nullptr && witness == nullptr; }
};

/// Runs the episodes, shared out to the team; with an audience on one worker, in order of their
/// beginning.
EvaluationResult evaluate(const Agent& agent, const Agent::Params& params,
                          const Evaluation& evaluation, Team& team, Audience audience = {});

/// How well M finds the target in `lanes` worlds of a level over the first `steps` steps.
GazeHits probe_gaze(const Agent& agent, const Agent::Params& params, const Agent::Tables& tables,
                    const babyai::LevelSpec& level, int lanes, int steps, std::uint64_t seed);

}  // namespace wordgaze::rl
