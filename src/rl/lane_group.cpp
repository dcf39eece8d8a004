#include "wordgaze/rl/lane_group.hpp"

#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::rl {
namespace {

/// Far from the small seeds that evaluation uses: training never sees those worlds on purpose.
std::uint64_t world_seed(std::int64_t run, int lane) {
  return (std::uint64_t{1} << 63) + static_cast<std::uint64_t>(run) * 1'000'003 +
         static_cast<std::uint64_t>(lane);
}

core::Rng lane_rng(std::int64_t run, int lane) {
  return core::Rng((std::uint64_t{1} << 62) + static_cast<std::uint64_t>(run) * 1'000'003 +
                   static_cast<std::uint64_t>(lane));
}

}  // namespace

LaneGroup::LaneGroup(const Agent& agent, const TrainConfig& config, const babyai::LevelSpec& level,
                     int first, int lanes)
    : agent_(&agent), ppo_(&config.ppo), first_(first), actor_(agent, lanes) {
  const Curriculum beginning(config.curriculum);
  const env::Environment blank(level);
  for (int lane = 0; lane < lanes; ++lane) {
    lanes_.push_back({blank, lane_rng(config.seed, first + lane)});
    lanes_.back().environment.reset(world_seed(config.seed, first + lane));
    start_episode(lane, beginning);
  }
  cut_frames_.resize(agent.config, {1, lanes});
}

void LaneGroup::start_episode(int index, const Curriculum& curriculum) {
  Lane& lane = lanes_[static_cast<std::size_t>(index)];
  const auto prepared = curriculum.prepare(lane.environment, lane.rng);
  lane.helped = prepared.helped;
  lane.stretch = prepared.stretch;
  lane.episode_return = 0;
  actor_.begin(index, lane.environment.sentence());
}

void LaneGroup::collect(const Agent::Params& params, const Agent::Tables& tables,
                        const Curriculum& curriculum, Rollout& rollout, Observer* observer) {
  outcomes_.clear();
  hits_ = {};
  cut_count_ = 0;
  actor_.refresh();
  const int lanes = actor_.lanes();
  for (Index t = 0; t < rollout.shape.steps; ++t) {
    if (t % rollout.chunk == 0) {
      const Index sequence = (t / rollout.chunk) * rollout.shape.batch + first_;
      rollout.start_h.middleCols(sequence, lanes) = actor_.frames().start.h;
      rollout.start_c.middleCols(sequence, lanes) = actor_.frames().start.c;
    }
    look();
    actor_.decide(params, tables);
    const auto& frames = actor_.frames();
    const Index base = rollout.shape.column(t, first_);
    rollout.cells.middleCols(base, lanes) = frames.cells;
    rollout.keep.middleCols(base, lanes) = frames.keep;
    rollout.completion.middleCols(base, lanes) = frames.completion;
    actor_.advance();
    for (int b = 0; b < lanes; ++b) {
      step_lane(b, base + b, curriculum, rollout, b == 0 ? observer : nullptr);
    }
  }
  value_cuts(params, tables, rollout);
  look();
  actor_.decide(params, tables);
  for (int b = 0; b < lanes; ++b) {
    rollout.next_value[static_cast<std::size_t>(first_ + b)] = actor_.cache().values()(0, b);
  }
}

void LaneGroup::look() {
  for (int b = 0; b < actor_.lanes(); ++b) look(b);
}

void LaneGroup::look(int b) {
  const Lane& lane = lanes_[static_cast<std::size_t>(b)];
  actor_.observe(b, lane.environment);
  lane.stretch.apply(agent_->alphabet, actor_.frames().cells.col(b));
}

void LaneGroup::step_lane(int b, Index column, const Curriculum& curriculum, Rollout& rollout,
                          Observer* observer) {
  using Choice = nn::Categorical<float>;
  Lane& lane = lanes_[static_cast<std::size_t>(b)];
  env::Environment& environment = lane.environment;
  const auto& cache = actor_.cache();
  const auto n = static_cast<std::size_t>(column);

  std::array<float, grid::kActions> log_p;
  Choice::log_softmax({cache.logits().col(b).data(), grid::kActions}, log_p);
  const auto action = Choice::sample(log_p, static_cast<float>(lane.rng.uniform()));
  rollout.action[n] = static_cast<std::uint8_t>(action);
  rollout.log_prob[n] = log_p[action];
  rollout.value[n] = cache.values()(0, b);
  rollout.mission_of[n] = actor_.frames().mission_of[static_cast<std::size_t>(b)];
  rollout.bright[n] = model::bright_sub_tasks(ppo_->mask_truth, environment.progress());
  hits_.add(*agent_, actor_, b, environment);
  // A stretched view is not what a record would show.
  if (observer != nullptr && environment.step_count() == 0 && lane.stretch == Stretch{}) {
    recorder_.emplace(*observer);
    if (!recorder_->begin(lane.episode, first_, 0, environment)) recorder_.reset();
  }
  const bool recorded = observer != nullptr && recorder_.has_value();
  if (recorded) {
    recorder_->decide(*agent_, actor_, b, environment, static_cast<int>(action),
                      Choice::entropy(log_p));
  }

  const env::Transition transition = environment.step(static_cast<grid::Action>(action));
  lane.episode_return += transition.reward;
  rollout.reward[n] = static_cast<float>(transition.reward);
  rollout.ended[n] = transition.terminated || transition.truncated;
  if (recorded) recorder_->step(transition);
  if (!rollout.ended[n]) return;

  const Outcome outcome{.verb = environment.instruction().clause[0].verb,
                        .clauses = environment.instruction().clauses(),
                        .helped = lane.helped,
                        .success = transition.terminated && transition.reward > 0,
                        .truncated = !transition.terminated,
                        .steps = environment.step_count(),
                        .episode_return = lane.episode_return};
  outcomes_.push_back(outcome);
  if (recorded) {
    recorder_->end({.episode = lane.episode,
                    .lane = first_,
                    .steps = outcome.steps,
                    .episode_return = outcome.episode_return,
                    .success = outcome.success,
                    .truncated = outcome.truncated});
    recorder_.reset();
  }
  if (outcome.truncated) keep_cut(b, column);
  ++lane.episode;
  environment.reset();
  start_episode(b, curriculum);
}

void LaneGroup::keep_cut(int b, Index column) {
  if (cut_count_ == cuts_.size()) cuts_.emplace_back();
  Cut& cut = cuts_[cut_count_++];
  const int lane_mission = actor_.frames().mission_of[static_cast<std::size_t>(b)];
  look(b);  // the final observation
  cut.column = column;
  cut.mission = lane_mission;
  cut.cells = actor_.frames().cells.col(b);
  cut.completion = actor_.frames().completion.col(b);
  cut.h = actor_.frames().start.h.col(b);
  cut.c = actor_.frames().start.c.col(b);
}

/// Truncation is not an end of the task: what would have followed is worth discount * V(final).
void LaneGroup::value_cuts(const Agent::Params& params, const Agent::Tables& tables,
                           Rollout& rollout) {
  const auto batch = static_cast<std::size_t>(cut_frames_.shape.batch);
  // Columns that are left over run along; what they held was of missions that are forgotten.
  std::fill(cut_frames_.mission_of.begin(), cut_frames_.mission_of.end(), 0);
  for (std::size_t from = 0; from < cut_count_; from += batch) {
    const std::size_t size = std::min(batch, cut_count_ - from);
    for (std::size_t i = 0; i < size; ++i) {
      const Cut& cut = cuts_[from + i];
      const auto column = static_cast<Index>(i);
      cut_frames_.mission_of[i] = cut.mission;
      cut_frames_.cells.col(column) = cut.cells;
      cut_frames_.completion.col(column) = cut.completion;
      cut_frames_.start.h.col(column) = cut.h;
      cut_frames_.start.c.col(column) = cut.c;
    }
    agent_->forward(params, tables, cut_frames_, actor_.missions(), actor_.text(), cut_cache_);
    for (std::size_t i = 0; i < size; ++i) {
      rollout.reward[static_cast<std::size_t>(cuts_[from + i].column)] +=
          static_cast<float>(ppo_->discount) * cut_cache_.values()(0, static_cast<Index>(i));
    }
  }
}

LaneGroup::LaneState LaneGroup::state(int b) const {
  const Lane& lane = lanes_[static_cast<std::size_t>(b)];
  const auto& frames = actor_.frames();
  return {.environment = lane.environment.serialize(),
          .rng = lane.rng.state(),
          .begins = frames.keep(0, b) == 0,
          .helped = lane.helped,
          .stretch = lane.stretch,
          .episode = lane.episode,
          .episode_return = lane.episode_return,
          .h = frames.start.h.col(b),
          .c = frames.start.c.col(b)};
}

void LaneGroup::restore(int b, const LaneState& state) {
  Lane& lane = lanes_[static_cast<std::size_t>(b)];
  lane.environment.restore(state.environment);
  lane.rng = core::Rng(state.rng);
  lane.helped = state.helped;
  lane.stretch = state.stretch;
  lane.episode = state.episode;
  lane.episode_return = state.episode_return;
  actor_.begin(b, lane.environment.sentence());
  auto& frames = actor_.frames();
  frames.keep(0, b) = state.begins ? 0.0f : 1.0f;
  frames.start.h.col(b) = state.h;
  frames.start.c.col(b) = state.c;
}

}  // namespace wordgaze::rl
