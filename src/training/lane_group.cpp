#include "wordgaze/training/lane_group.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "wordgaze/model/task_mask.hpp"
#include "wordgaze/training/divergence.hpp"

namespace wordgaze::training {
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

LaneGroup::LaneGroup(std::unique_ptr<policy::Policy> policy, const TrainConfig& config,
                     const babyai::LevelSpec& level, int first)
    : ppo_(&config.ppo), first_(first), policy_(std::move(policy)) {
  const Curriculum beginning(config.curriculum);
  const env::Environment blank(level);
  for (int lane = 0; lane < policy_->lanes(); ++lane) {
    lanes_.push_back({evaluation::Episode(blank), lane_rng(config.seed, first + lane)});
    lanes_.back().episode.environment.reset(world_seed(config.seed, first + lane));
    start_episode(lane, beginning);
    observe(lane);
  }
}

/// An episode that has just been reset.
void LaneGroup::start_episode(int index, const Curriculum& curriculum) {
  Lane& lane = lanes_[static_cast<std::size_t>(index)];
  const auto prepared = curriculum.prepare(lane.episode.environment, lane.rng);
  lane.helped = prepared.helped;
  lane.stretch = prepared.stretch;
  lane.episode.begin(*policy_, index);
}

void LaneGroup::collect(const Curriculum& curriculum, Rollout& rollout,
                        policy::Observer* observer) {
  outcomes_.clear();
  pointing_ = {};
  cuts_.clear();
  policy_->refresh();
  const int lanes = policy_->lanes();
  for (int b = 0; b < lanes; ++b) {
    rollout.missions[static_cast<std::size_t>(first_ + b)].assign(
        1, lanes_[static_cast<std::size_t>(b)].episode.environment.sentence());
  }
  const auto sampler = [&](int b, std::span<const float> log_probs) {
    return policy::Sampled{lanes_[static_cast<std::size_t>(b)].rng}(b, log_probs);
  };
  for (Index t = 0; t < rollout.shape.steps; ++t) {
    for (int b = 0; b < lanes; ++b) observe(b);
    const auto& frames = policy_->frames();
    if (t % rollout.chunk == 0) {
      const Index sequence = (t / rollout.chunk) * rollout.shape.batch + first_;
      rollout.start_h.middleCols(sequence, lanes) = frames.start.h;
      rollout.start_c.middleCols(sequence, lanes) = frames.start.c;
    }
    const Index base = rollout.shape.column(t, first_);
    rollout.cells.middleCols(base, lanes) = frames.cells;
    rollout.keep.middleCols(base, lanes) = frames.keep;
    rollout.completion.middleCols(base, lanes) = frames.completion;
    const auto decisions = policy_->decide(sampler);
    for (int b = 0; b < lanes; ++b) {
      step_lane(b, base + b, decisions[static_cast<std::size_t>(b)], curriculum, rollout, observer);
    }
  }
  check_memories();
  value_cuts(rollout);
  for (int b = 0; b < lanes; ++b) observe(b);
  const auto values = policy_->values();
  std::copy(values.begin(), values.end(), rollout.next_value.begin() + first_);
}

/// 0 x NaN is NaN: a memory that is not finite once would outlive every episode's end.
void LaneGroup::check_memories() const {
  for (int b = 0; b < policy_->lanes(); ++b) {
    const auto& [h, c] = policy_->frames().start;
    if (h.col(b).allFinite() && c.col(b).allFinite()) continue;
    fail_diverged("the memory of lane " + std::to_string(first_ + b) + " is not finite");
  }
}

void LaneGroup::observe(int b) {
  Lane& lane = lanes_[static_cast<std::size_t>(b)];
  lane.episode.observe();
  lane.stretch.apply(lane.episode.observation.image);
  policy_->observe(b, lane.episode.observation);
}

void LaneGroup::step_lane(int b, Index column, const policy::Decision& decision,
                          const Curriculum& curriculum, Rollout& rollout,
                          policy::Observer* observer) {
  Lane& lane = lanes_[static_cast<std::size_t>(b)];
  evaluation::Episode& episode = lane.episode;
  const babyai::Progress progress = episode.environment.progress();
  auto& missions = rollout.missions[static_cast<std::size_t>(first_ + b)];
  const auto n = static_cast<std::size_t>(column);
  rollout.mission_of[n] = static_cast<int>(missions.size()) - 1;
  rollout.action[n] = static_cast<std::uint8_t>(decision.action);
  rollout.log_prob[n] = decision.log_prob;
  rollout.value[n] = decision.value;
  rollout.bright[n] = model::bright_sub_tasks(ppo_->mask_truth, progress);
  pointing_.add(*policy_, b, episode.observation.image, progress);

  const bool begins = episode.environment.step_count() == 0;
  const bool goes_on = std::exchange(lane.restored, false);
  if (b == 0 && observer != nullptr && (begins || goes_on) && lane.stretch == Stretch{}) {
    episode.report(*observer, {.number = lane.number, .lane = first_});
  }
  const auto step = episode.step(*policy_, b, decision);
  rollout.reward[n] = static_cast<float>(step.transition.reward);
  rollout.ended[n] = step.ended();
  if (!step.ended()) return;

  const auto& instruction = episode.environment.instruction();
  outcomes_.push_back(
      {episode.outcome(), instruction.clause[0].verb, instruction.clauses(), lane.helped});
  if (episode.outcome().truncated) {
    observe(b);  // the final observation
    policy_->keep(b);
    cuts_.push_back(column);
  }
  ++lane.number;
  episode.environment.reset();
  start_episode(b, curriculum);
  missions.push_back(episode.environment.sentence());
}

/// Truncation is not an end of the task: what would have followed is worth discount * V(final).
void LaneGroup::value_cuts(Rollout& rollout) {
  const auto values = policy_->kept_values();
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    rollout.reward[static_cast<std::size_t>(cuts_[i])] +=
        static_cast<float>(ppo_->discount) * values[i];
  }
}

LaneGroup::LaneState LaneGroup::state(int b) const {
  const Lane& lane = lanes_[static_cast<std::size_t>(b)];
  return {.environment = lane.episode.environment.serialize(),
          .rng = lane.rng.state(),
          .helped = lane.helped,
          .stretch = lane.stretch,
          .episode = lane.number,
          .episode_return = lane.episode.episode_return(),
          .memory = policy_->memory(b)};
}

void LaneGroup::restore(int b, const LaneState& state) {
  if (!state.memory.h.allFinite() || !state.memory.c.allFinite()) {
    throw std::runtime_error("the memory of lane " + std::to_string(first_ + b) +
                             " ('lanes.h', 'lanes.c') is not finite");
  }
  Lane& lane = lanes_[static_cast<std::size_t>(b)];
  lane.episode.environment.restore(state.environment);
  lane.rng = core::Rng(state.rng);
  lane.helped = state.helped;
  lane.stretch = state.stretch;
  lane.number = state.episode;
  lane.restored = true;
  lane.episode.begin(*policy_, b);
  lane.episode.set_episode_return(state.episode_return);
  policy_->set_memory(b, state.memory);
  observe(b);
}

}  // namespace wordgaze::training
