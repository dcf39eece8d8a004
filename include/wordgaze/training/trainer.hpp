#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/evaluation/evaluator.hpp"
#include "wordgaze/optim/schedule.hpp"
#include "wordgaze/policy/level_file.hpp"
#include "wordgaze/training/gae.hpp"
#include "wordgaze/training/lane_group.hpp"
#include "wordgaze/training/learner.hpp"
#include "wordgaze/training/metrics.hpp"

namespace wordgaze::training {

/// What training goes on from, but for the weights and the optimizer.
struct RunState {
  std::int64_t updates = 0, frames = 0;
  double seconds = 0;
  std::int64_t adam_steps = 0;
  core::Rng::State rng;
  std::vector<double> curriculum;
  std::vector<Outcome> recent;  ///< that the means run over, oldest first
  double hit_12 = 0;
  std::vector<LaneGroup::LaneState> lanes;
};

/// Everything that training goes on from: the same state, configuration and number of threads give
/// the same bits.
template <class Params>
struct TrainerState : RunState {
  Params params, adam_mean, adam_variance;
};

/// The last episodes that count, and what can be said of them.
class RecentOutcomes {
 public:
  void add(const std::vector<Outcome>& outcomes);
  void summarize(Metrics& metrics) const;

  std::vector<Outcome> state() const { return {outcomes_.begin(), outcomes_.end()}; }
  void restore(const std::vector<Outcome>& outcomes) {
    outcomes_.assign(outcomes.begin(), outcomes.end());
  }

 private:
  static constexpr std::size_t kRecent = 1000;
  std::deque<Outcome> outcomes_;
};

/// How far the gaze has focused after so many frames, in [0, 1].
double focus_at(const TrainConfig& config, std::int64_t frames);

/// Learning rates and entropy bonus after so many frames.
Rates rates_at(const TrainConfig& config, std::int64_t frames);

/// The level with 12 objects, for the probe of the gaze; none where they do not fit or mean
/// nothing.
std::optional<babyai::LevelSpec> crowded(const babyai::LevelSpec& level);

/// Recurrent PPO: collect a rollout, estimate advantages, learn from it, again and again.
template <class Agent>
class BasicTrainer {
 public:
  using Params = typename Agent::Params;
  using State = TrainerState<Params>;

  /// Starts from fresh weights in a level. Throws std::invalid_argument for settings that do not
  /// fit together.
  BasicTrainer(const TrainConfig& config, const babyai::LevelSpec& level)
      : config_(config),
        level_(checked(level)),
        agent_(config.model, policy::alphabet_of(level_)),
        team_(config.threads),
        rng_(run_rng(2)),
        curriculum_(config.curriculum),
        rollout_(config.model, config.ppo),
        learner_(agent_, config_.ppo, make_losses<typename Agent::Scalar>(config.model, config.ppo),
                 fresh_params(), team_) {
    rollout_.actions = level_.actions;
    for (int w = 0; w < team_.size(); ++w) {
      const auto [from, to] = team_.share(config.ppo.lanes, w);
      groups_.push_back(std::make_unique<LaneGroup>(policy(to - from), config_, level_, from));
    }
  }
  /// In the level that the configuration names.
  explicit BasicTrainer(const TrainConfig& config)
      : BasicTrainer(config, policy::level_of(config.env, config.level)) {}
  BasicTrainer(const BasicTrainer&) = delete;
  BasicTrainer& operator=(const BasicTrainer&) = delete;

  /// Starts from these weights instead, with fresh moments of the optimizer.
  void set_params(Params params) {
    typename Learner<Agent>::Adam adam(params);
    learner_.restore(std::move(params), std::move(adam));
  }
  /// Another term of the loss; before the first update.
  void add_loss(std::unique_ptr<Loss> loss) { learner_.add_loss(std::move(loss)); }

  State state() const;
  void restore(State state);

  /// One update; returns its row of metrics. With an observer, episodes of the first lane that it
  /// wants are reported, and the metrics. Throws std::runtime_error where training has diverged:
  /// then the state is one of no update, and not to be saved.
  Metrics update(policy::Observer* observer = nullptr);
  /// The columns of that row.
  std::vector<std::string> columns() const;

  std::int64_t frames() const { return frames_; }
  std::int64_t updates() const { return updates_; }
  /// Of training so far, for a run that goes on: a checkpoint does not know them.
  void set_seconds(double seconds) { seconds_ = seconds; }
  bool finished() const { return frames_ >= config_.frames; }
  const TrainConfig& config() const { return config_; }
  const babyai::LevelSpec& level() const { return level_; }
  const Agent& agent() const { return agent_; }
  const typename Agent::Weights& weights() const { return learner_.weights(); }
  const Params& params() const { return learner_.params(); }

 private:
  const babyai::LevelSpec& checked(const babyai::LevelSpec& level) const {
    validate(config_);
    return level;
  }
  /// Streams of one run that must not meet: weights and order of sequences.
  core::Rng run_rng(std::uint64_t stream) const {
    return core::Rng((stream << 56) + static_cast<std::uint64_t>(config_.seed));
  }
  Params fresh_params() const {
    core::Rng rng = run_rng(1);
    return agent_.initialize(rng);
  }
  std::unique_ptr<policy::Policy> policy(int lanes) const {
    return std::make_unique<policy::NetworkPolicy<Agent>>(agent_, learner_.weights(), lanes);
  }
  double probe() const;
  /// Calls f(group, lane of the group) for all lanes in order.
  template <class F>
  void for_each_lane(F&& f) const {
    for (int w = 0; w < team_.size(); ++w) {
      const auto [from, to] = team_.share(config_.ppo.lanes, w);
      for (int lane = 0; lane < to - from; ++lane) f(*groups_[static_cast<std::size_t>(w)], lane);
    }
  }

  TrainConfig config_;
  babyai::LevelSpec level_;
  Agent agent_;
  Team team_;
  core::Rng rng_;
  Curriculum curriculum_;
  Rollout rollout_;
  Learner<Agent> learner_;
  std::vector<std::unique_ptr<LaneGroup>> groups_;  // one a worker
  RecentOutcomes recent_;
  std::int64_t updates_ = 0, frames_ = 0;
  double seconds_ = 0;
  double hit_12_ = std::numeric_limits<double>::quiet_NaN();
};

template <class Agent>
Metrics BasicTrainer<Agent>::update(policy::Observer* observer) {
  const auto begin = std::chrono::steady_clock::now();
  learner_.set_focus(focus_at(config_, frames_));
  team_.run([&](int w) {
    groups_[static_cast<std::size_t>(w)]->collect(curriculum_, rollout_,
                                                  w == 0 ? observer : nullptr);
  });
  estimate_advantages(rollout_.shape, rollout_.reward, rollout_.value, rollout_.ended,
                      rollout_.next_value, static_cast<float>(config_.ppo.discount),
                      static_cast<float>(config_.ppo.gae_lambda), rollout_.advantage);
  const Rates rates = rates_at(config_, frames_);
  const auto report = learner_.learn(rollout_, rates, rng_);

  ++updates_;
  frames_ += rollout_.shape.columns();
  evaluation::Pointing pointing;
  for (const auto& group : groups_) {
    pointing += group->pointing();
    recent_.add(group->outcomes());
    curriculum_.observe(group->outcomes(), frames_);
  }
  if (config_.probe_every > 0 && (updates_ - 1) % config_.probe_every == 0) hit_12_ = probe();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  Metrics m;
  m.frames = static_cast<double>(frames_);
  m.seconds = seconds_;
  m.policy_loss = report.of("policy_loss");
  m.value_loss = report.of("value_loss");
  m.mask_loss = report.of("mask_loss");
  m.entropy = report.of("entropy");
  m.kl = report.of("kl");
  m.clip_fraction = report.of("clip_fraction");
  m.gradient_norm = report.gradient_norm;
  m.learning_rate = rates.learning_rate;
  m.task_learning_rate = config_.model.task_attention ? rates.task_learning_rate
                                                      : std::numeric_limits<double>::quiet_NaN();
  m.hit = pointing.target.value();
  m.hit_12 = hit_12_;
  m.go_to_share = curriculum_.pickup_only() ? 0 : curriculum_.go_to_share();
  m.skipped = report.skipped;
  recent_.summarize(m);
  const auto known = Metrics{}.columns();
  for (const auto& [name, value] : report.losses) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      m.others.emplace_back(name, value);
  }
  if (observer != nullptr) {
    const auto names = m.columns();
    const auto values = m.values();
    std::vector<policy::Scalar> scalars;
    for (std::size_t i = 0; i < values.size(); ++i) scalars.push_back({names[i], values[i]});
    observer->on_update({updates_, frames_, scalars});
  }
  return m;
}

template <class Agent>
std::vector<std::string> BasicTrainer<Agent>::columns() const {
  std::vector<std::string> names = Metrics{}.columns();
  for (const auto& loss : learner_.losses()) {
    for (const auto name : loss->reports()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
    }
  }
  return names;
}

/// The gaze among 12 objects, in worlds of its own.
template <class Agent>
double BasicTrainer<Agent>::probe() const {
  constexpr int kLanes = 64, kSteps = 16;
  const auto level = crowded(level_);
  if (!config_.model.attention || !level) return std::numeric_limits<double>::quiet_NaN();
  return evaluation::probe_gaze(*policy(kLanes), *level, kSteps,
                                (std::uint64_t{1} << 61) + static_cast<std::uint64_t>(updates_))
      .target.value();
}

template <class Agent>
typename BasicTrainer<Agent>::State BasicTrainer<Agent>::state() const {
  State s{{.updates = updates_,
           .frames = frames_,
           .seconds = seconds_,
           .adam_steps = learner_.adam().steps,
           .rng = rng_.state(),
           .curriculum = curriculum_.state(),
           .recent = recent_.state(),
           .hit_12 = hit_12_,
           .lanes = {}},
          learner_.params(),
          learner_.adam().mean,
          learner_.adam().variance};
  for_each_lane([&](const LaneGroup& group, int lane) { s.lanes.push_back(group.state(lane)); });
  return s;
}

template <class Agent>
void BasicTrainer<Agent>::restore(State s) {
  require(s.lanes.size() == static_cast<std::size_t>(config_.ppo.lanes),
          "Trainer: the state has {} lanes, the configuration {}", s.lanes.size(),
          config_.ppo.lanes);
  updates_ = s.updates;
  frames_ = s.frames;
  seconds_ = s.seconds;
  rng_ = core::Rng(s.rng);
  curriculum_.restore(s.curriculum);
  recent_.restore(s.recent);
  hit_12_ = s.hit_12;
  typename Learner<Agent>::Adam adam(s.params);
  adam.mean = std::move(s.adam_mean);
  adam.variance = std::move(s.adam_variance);
  adam.steps = s.adam_steps;
  learner_.restore(std::move(s.params), std::move(adam));
  auto state = s.lanes.begin();
  for_each_lane([&](LaneGroup& group, int lane) { group.restore(lane, *state++); });
}

/// Of the library's network.
using Trainer = BasicTrainer<policy::Agent>;

}  // namespace wordgaze::training

extern template class wordgaze::training::Learner<wordgaze::policy::Agent>;
extern template class wordgaze::training::BasicTrainer<wordgaze::policy::Agent>;
