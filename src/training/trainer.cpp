#include "wordgaze/training/trainer.hpp"

#include <algorithm>

#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/core/require.hpp"

template class wordgaze::training::Learner<wordgaze::policy::Agent>;
template class wordgaze::training::BasicTrainer<wordgaze::policy::Agent>;

namespace wordgaze::training {

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
  require(c.ppo.focus_start <= c.ppo.focus_end,
          "ppo: focus_start = {} is after focus_end = {}; set ppo.focus_end to more",
          c.ppo.focus_start, c.ppo.focus_end);
  require(c.threads <= c.ppo.lanes, "threads = {} is more than ppo.lanes = {}", c.threads,
          c.ppo.lanes);
}

double focus_at(const TrainConfig& config, std::int64_t frames) {
  const double done = static_cast<double>(frames) / static_cast<double>(config.frames);
  const double from = config.ppo.focus_start, to = config.ppo.focus_end;
  return done >= to ? 1 : std::clamp((done - from) / (to - from), 0.0, 1.0);
}

Rates rates_at(const TrainConfig& config, std::int64_t frames) {
  const auto& ppo = config.ppo;
  const auto progress = static_cast<double>(frames);
  const double left =
      optim::linear(1, ppo.learning_rate_end, progress, static_cast<double>(config.frames));
  return {.learning_rate = ppo.learning_rate * left,
          .task_learning_rate = ppo.task_learning_rate * left,
          .entropy_coefficient =
              optim::linear(ppo.entropy_start, ppo.entropy_end, progress, ppo.entropy_frames)};
}

std::optional<babyai::LevelSpec> crowded(const babyai::LevelSpec& level) {
  constexpr int kObjects = 12;
  const int inside = level.room_size - 2;
  const bool fit = inside * inside >= 3 * kObjects && babyai::max_objects(level) >= kObjects;
  if (babyai::objects(level).value_or(0) == 0 || !fit) return std::nullopt;
  return babyai::with_objects(level, kObjects);
}

void RecentOutcomes::add(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    if (outcome.helped) continue;
    outcomes_.push_back(outcome);
    if (outcomes_.size() > kRecent) outcomes_.pop_front();
  }
}

void RecentOutcomes::summarize(Metrics& m) const {
  const auto mean = [&](auto&& counts, auto&& value) {
    double sum = 0, n = 0;
    for (const Outcome& outcome : outcomes_) {
      if (!counts(outcome)) continue;
      sum += static_cast<double>(value(outcome));
      n += 1;
    }
    return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
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

}  // namespace wordgaze::training
