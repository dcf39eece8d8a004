#pragma once
#include <deque>
#include <limits>
#include <memory>

#include "wordgaze/rl/lane_group.hpp"
#include "wordgaze/rl/learner.hpp"
#include "wordgaze/rl/metrics.hpp"

namespace wordgaze::rl {

/// Everything that training goes on from: the same state, configuration and number of threads give
/// the same bits.
struct TrainerState {
  std::int64_t updates = 0, frames = 0;
  double seconds = 0;
  Agent::Params params, adam_mean, adam_variance;
  std::int64_t adam_steps = 0;
  core::Rng::State rng;
  std::vector<double> curriculum;
  std::vector<Outcome> recent;  ///< that the means run over, oldest first
  double hit_12 = 0;
  std::vector<LaneGroup::LaneState> lanes;
};

/// Recurrent PPO: collect a rollout, estimate advantages, learn from it, again and again.
class Trainer {
 public:
  /// Starts from fresh weights. Throws std::invalid_argument for settings or an environment that do
  /// not fit.
  explicit Trainer(const TrainConfig& config);
  Trainer(const Trainer&) = delete;
  Trainer& operator=(const Trainer&) = delete;

  /// Starts from these weights instead, with fresh moments of the optimizer.
  void set_params(Agent::Params params);

  TrainerState state() const;
  void restore(TrainerState state);

  /// One update; returns its row of metrics. With an observer, episodes of the first lane that it
  /// wants are reported, and the metrics.
  Metrics update(Observer* observer = nullptr);

  std::int64_t frames() const { return frames_; }
  std::int64_t updates() const { return updates_; }
  bool finished() const { return frames_ >= config_.frames; }
  const TrainConfig& config() const { return config_; }
  const Agent& agent() const { return agent_; }
  const Agent::Params& params() const { return learner_.params(); }

 private:
  static constexpr std::size_t kRecent = 1000;

  void remember(const std::vector<Outcome>& outcomes);
  void summarize(Metrics& metrics) const;
  double probe() const;

  TrainConfig config_;
  babyai::LevelSpec level_;
  Agent agent_;
  Team team_;
  core::Rng rng_;
  Curriculum curriculum_;
  Rollout rollout_;
  Learner learner_;
  std::vector<std::unique_ptr<LaneGroup>> groups_;  // one a worker
  std::vector<const model::Missions*> missions_of_lane_;
  std::deque<Outcome> recent_;
  std::int64_t updates_ = 0, frames_ = 0;
  double seconds_ = 0;
  double hit_12_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace wordgaze::rl
