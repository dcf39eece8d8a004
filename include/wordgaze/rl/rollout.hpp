#pragma once
#include <vector>

#include "wordgaze/model/agent.hpp"
#include "wordgaze/rl/config.hpp"

namespace wordgaze::rl {

/// What a rollout leaves to learn from: one column a frame, time-major over all lanes.
struct Rollout {
  nn::SequenceShape shape;      ///< steps, lanes
  int chunk = 0;                ///< steps of a training sequence
  model::CellMatrix cells;      ///< [49, N]
  std::vector<int> mission_of;  ///< [N] index into the missions of the lane's worker
  Matrix<float> keep;           ///< [1, N]
  Matrix<float> completion;     ///< [clauses, N]
  std::vector<std::uint8_t> action, ended, bright;        ///< [N]; bright: the true mask, by clause
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
};

}  // namespace wordgaze::rl
