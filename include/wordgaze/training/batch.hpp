#pragma once
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/model/frames.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/training/rollout.hpp"

namespace wordgaze::training {

/// How the advantages of a minibatch are normalized.
struct AdvantageScale {
  double mean = 0, factor = 1;
  double operator()(double advantage) const { return (advantage - mean) * factor; }
};
/// Mean 0 and deviation 1, but never divided by less than `floor`: rare successes of a random
/// policy would be blown up to noise of size one.
AdvantageScale advantage_scale(const Rollout& rollout, std::span<const int> sequences,
                               double floor);

/// What one worker learns from in a minibatch: the network's input, and for each frame what was
/// done and what came of it. N frames, a column each.
template <std::floating_point S>
struct BasicBatch {
  model::Frames<S> frames;
  model::Missions missions;           ///< that frames.mission_of counts in
  int actions = grid::kActions;       ///< that were possible: the first so many
  std::vector<std::uint8_t> action;   ///< [N]
  std::vector<std::uint16_t> bright;  ///< [N] the true mask, by sub-task
  std::vector<S> log_prob;            ///< [N] of the action when it was taken
  std::vector<S> advantage;           ///< [N] normalized
  std::vector<S> value_target;        ///< [N]

  /// Copies the columns of some training sequences.
  void gather(const model::Config& config, const Rollout& rollout, std::span<const int> sequences,
              const AdvantageScale& scale);

  const babyai::Sentence& mission(Index column) const { return missions[frames.mission(column)]; }
};
using Batch = BasicBatch<float>;

extern template struct BasicBatch<float>;
extern template struct BasicBatch<double>;  // for whoever learns in double precision

}  // namespace wordgaze::training
