#include "wordgaze/rl/trainer.hpp"

#include <chrono>

#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/model/initialize.hpp"
#include "wordgaze/optim/schedule.hpp"
#include "wordgaze/rl/alphabet.hpp"
#include "wordgaze/rl/evaluator.hpp"
#include "wordgaze/rl/gae.hpp"

namespace wordgaze::rl {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

const TrainConfig& checked(const TrainConfig& config) {
  validate(config);
  return config;
}

/// Streams of one run that must not meet: weights and order of sequences.
core::Rng run_rng(std::int64_t seed, std::uint64_t stream) {
  return core::Rng((stream << 56) + static_cast<std::uint64_t>(seed));
}

Agent::Params fresh_params(const Agent& agent, std::int64_t seed) {
  core::Rng rng = run_rng(seed, 1);
  return model::initialize(agent, rng);
}

}  // namespace

void validate(const TrainConfig& c) {
  model::validate(c.model);
  require(c.ppo.steps % c.ppo.chunk == 0,
          "ppo: chunk = {} does not divide steps = {}; set ppo.chunk to a divisor", c.ppo.chunk,
          c.ppo.steps);
  const int sequences = c.ppo.lanes * (c.ppo.steps / c.ppo.chunk);
  require(
      sequences % c.ppo.minibatches == 0,
      "ppo: minibatches = {} does not divide the {} training sequences (lanes * steps / chunk); "
      "set ppo.minibatches to a divisor",
      c.ppo.minibatches, sequences);
  require(c.threads <= c.ppo.lanes, "threads = {} is more than ppo.lanes = {}", c.threads,
          c.ppo.lanes);
}

Trainer::Trainer(const TrainConfig& config)
    : config_(checked(config)),
      level_(babyai::find_level(config.env)),
      agent_{config.model, alphabet_of(level_)},
      team_(config.threads),
      rng_(run_rng(config.seed, 2)),
      curriculum_(config.curriculum),
      rollout_(config.model, config.ppo),
      learner_(agent_, config_.ppo, fresh_params(agent_, config.seed), team_) {
  for (int w = 0; w < team_.size(); ++w) {
    const auto [from, to] = team_.share(config.ppo.lanes, w);
    groups_.push_back(std::make_unique<LaneGroup>(agent_, config_, level_, from, to - from));
    missions_of_lane_.insert(missions_of_lane_.end(), static_cast<std::size_t>(to - from),
                             &groups_.back()->missions());
  }
}

void Trainer::set_params(Agent::Params params) {
  optim::Adam<Agent::Params> adam(params);
  learner_.restore(std::move(params), std::move(adam));
}

Metrics Trainer::update(Observer* observer) {
  const auto begin = std::chrono::steady_clock::now();
  team_.run([&](int w) {
    groups_[static_cast<std::size_t>(w)]->collect(learner_.params(), learner_.tables(), curriculum_,
                                                  rollout_, w == 0 ? observer : nullptr);
  });
  estimate_advantages(rollout_.shape, rollout_.reward, rollout_.value, rollout_.ended,
                      rollout_.next_value, static_cast<float>(config_.ppo.discount),
                      static_cast<float>(config_.ppo.gae_lambda), rollout_.advantage);

  const auto& ppo = config_.ppo;
  const auto progress = static_cast<double>(frames_);
  const double left =
      optim::linear(1, ppo.learning_rate_end, progress, static_cast<double>(config_.frames));
  const Learner::Rates rates{
      .base = ppo.learning_rate * left,
      .task = ppo.task_learning_rate * left,
      .entropy = optim::linear(ppo.entropy_start, ppo.entropy_end, progress, ppo.entropy_frames)};
  const Learner::Report report = learner_.learn(rollout_, missions_of_lane_, rates, rng_);

  ++updates_;
  frames_ += rollout_.shape.columns();
  GazeHits hits;
  for (const auto& group : groups_) {
    hits += group->hits();
    remember(group->outcomes());
    curriculum_.observe(group->outcomes(), frames_);
  }
  if (config_.probe_every > 0 && (updates_ - 1) % config_.probe_every == 0) hit_12_ = probe();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  Metrics m;
  m.frames = static_cast<double>(frames_);
  m.seconds = seconds_;
  m.policy_loss = report.loss.policy;
  m.value_loss = report.loss.value;
  m.mask_loss = config_.model.task_attention ? report.mask_loss : kNothing;
  m.entropy = report.loss.entropy;
  m.kl = report.loss.divergence;
  m.clip_fraction = report.loss.clipped;
  m.gradient_norm = report.gradient_norm;
  m.learning_rate = rates.base;
  m.task_learning_rate = config_.model.task_attention ? rates.task : kNothing;
  m.hit = hits.rate();
  m.hit_12 = hit_12_;
  m.go_to_share = curriculum_.pickup_only() ? 0 : curriculum_.go_to_share();
  m.skipped = report.skipped;
  summarize(m);
  return m;
}

void Trainer::remember(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    if (outcome.helped) continue;
    recent_.push_back(outcome);
    if (recent_.size() > kRecent) recent_.pop_front();
  }
}

void Trainer::summarize(Metrics& m) const {
  const auto mean = [&](auto&& counts, auto&& value) {
    double sum = 0, n = 0;
    for (const Outcome& outcome : recent_) {
      if (!counts(outcome)) continue;
      sum += static_cast<double>(value(outcome));
      n += 1;
    }
    return n > 0 ? sum / n : kNothing;
  };
  const auto all = [](const Outcome&) { return true; };
  const auto success = [](const Outcome& o) { return o.success; };
  const auto verb = [](babyai::Verb v) { return [v](const Outcome& o) { return o.verb == v; }; };
  m.success_rate = mean(all, success);
  m.mean_return = mean(all, [](const Outcome& o) { return o.episode_return; });
  m.mean_length = mean(all, [](const Outcome& o) { return o.steps; });
  m.success_go_to = mean(verb(babyai::Verb::go_to), success);
  m.success_pickup = mean(verb(babyai::Verb::pickup), success);
  m.truncated = mean(all, [](const Outcome& o) { return o.truncated; });
  m.done_wrong = mean(all, [](const Outcome& o) { return !o.success && !o.truncated; });
}

/// The gaze among 12 objects, in worlds of its own.
double Trainer::probe() const {
  constexpr int kObjects = 12, kLanes = 64, kSteps = 16;
  const int inside = level_.room_size - 2;
  const bool fits = inside * inside >= 3 * kObjects && babyai::max_objects(level_) >= kObjects;
  if (!config_.model.attention || babyai::objects(level_).value_or(0) == 0 || !fits)
    return kNothing;
  const babyai::LevelSpec crowded = babyai::with_objects(level_, kObjects);
  return probe_gaze(agent_, learner_.params(), learner_.tables(), crowded, kLanes, kSteps,
                    (std::uint64_t{1} << 61) + static_cast<std::uint64_t>(updates_))
      .rate();
}

TrainerState Trainer::state() const {
  TrainerState s{.updates = updates_,
                 .frames = frames_,
                 .seconds = seconds_,
                 .params = learner_.params(),
                 .adam_mean = learner_.adam().mean,
                 .adam_variance = learner_.adam().variance,
                 .adam_steps = learner_.adam().steps,
                 .rng = rng_.state(),
                 .curriculum = curriculum_.state(),
                 .recent = {recent_.begin(), recent_.end()},
                 .hit_12 = hit_12_,
                 .lanes = {}};
  for (int w = 0; w < team_.size(); ++w) {
    const auto [from, to] = team_.share(config_.ppo.lanes, w);
    for (int lane = 0; lane < to - from; ++lane) {
      s.lanes.push_back(groups_[static_cast<std::size_t>(w)]->state(lane));
    }
  }
  return s;
}

void Trainer::restore(TrainerState s) {
  require(s.lanes.size() == static_cast<std::size_t>(config_.ppo.lanes),
          "Trainer: the state has {} lanes, the configuration {}", s.lanes.size(),
          config_.ppo.lanes);
  updates_ = s.updates;
  frames_ = s.frames;
  seconds_ = s.seconds;
  rng_ = core::Rng(s.rng);
  curriculum_.restore(s.curriculum);
  recent_.assign(s.recent.begin(), s.recent.end());
  hit_12_ = s.hit_12;
  optim::Adam<Agent::Params> adam(s.params);
  adam.mean = std::move(s.adam_mean);
  adam.variance = std::move(s.adam_variance);
  adam.steps = s.adam_steps;
  learner_.restore(std::move(s.params), std::move(adam));
  for (int w = 0; w < team_.size(); ++w) {
    const auto [from, to] = team_.share(config_.ppo.lanes, w);
    for (int lane = from; lane < to; ++lane) {
      groups_[static_cast<std::size_t>(w)]->restore(lane - from,
                                                    s.lanes[static_cast<std::size_t>(lane)]);
    }
  }
}

}  // namespace wordgaze::rl
