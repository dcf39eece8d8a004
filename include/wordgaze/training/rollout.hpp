#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/nn/sequence.hpp"
#include "wordgaze/training/config.hpp"

namespace wordgaze::training {

/// What a rollout leaves to learn from: one column a frame, time-major over all lanes.
struct Rollout {
  nn::SequenceShape shape;                                ///< steps, lanes
  int chunk = 0;                                          ///< steps of a training sequence
  int actions = grid::kActions;                           ///< of the level: the first so many
  model::CellMatrix cells;                                ///< [49, N]
  std::vector<std::vector<babyai::Sentence>> missions;    ///< of each lane, in their order
  std::vector<int> mission_of;                            ///< [N] index into those of its lane
  Matrix<float> keep;                                     ///< [1, N]
  Matrix<float> completion;                               ///< [sub_tasks, N]
  std::vector<std::uint8_t> action, ended;                ///< [N]
  std::vector<std::uint16_t> bright;                      ///< [N] the true mask, by sub-task
  std::vector<float> log_prob, value, reward, advantage;  ///< [N]
  std::vector<float> next_value;                          ///< [lanes]
  Matrix<float> start_h, start_c;  ///< [H, chunks * lanes] memory before each training sequence

  Rollout(const model::Config& model, const PpoConfig& ppo);

  int chunks() const { return static_cast<int>(shape.steps) / chunk; }
  /// Training sequences: chunk k of a lane is number k * lanes + lane.
  int sequences() const { return chunks() * static_cast<int>(shape.batch); }
  int lane(int sequence) const { return sequence % static_cast<int>(shape.batch); }
  /// The column of step t of a training sequence.
  Index column(int sequence, Index t) const {
    return shape.column((sequence / shape.batch) * chunk + t, lane(sequence));
  }
  const babyai::Sentence& mission(int lane, Index column) const {
    return missions[static_cast<std::size_t>(lane)]
                   [static_cast<std::size_t>(mission_of[static_cast<std::size_t>(column)])];
  }
};

/// Names the first number that is not finite and that something is learned from, as "the value of
/// step 3 in lane 5"; empty where all are finite.
std::string first_not_finite(const Rollout& rollout);

}  // namespace wordgaze::training
