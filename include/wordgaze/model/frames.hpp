#pragma once
#include <concepts>
#include <cstddef>
#include <vector>

#include "wordgaze/core/types.hpp"
#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/nn/lstm.hpp"
#include "wordgaze/nn/sequence.hpp"

namespace wordgaze::model {

/// The network's input: `shape.batch` sequences of `shape.steps` frames, one column a frame,
/// time-major.
template <std::floating_point S>
struct Frames {
  nn::SequenceShape shape;
  CellMatrix cells;                   ///< [49, T*B] codes of the alphabet
  std::vector<int> mission_of;        ///< [T*B] index into Missions
  Matrix<S> keep;                     ///< [1, T*B] 0 where an episode begins, else 1
  Matrix<S> completion;               ///< [sub_tasks, T*B] c_t; 0 for sub-tasks that do not exist
  typename nn::Lstm<S>::State start;  ///< memory before the first step

  void resize(const Config& config, nn::SequenceShape new_shape) {
    shape = new_shape;
    cells.setZero(grid::kViewCells, shape.columns());
    mission_of.assign(static_cast<std::size_t>(shape.columns()), 0);
    keep.setOnes(1, shape.columns());
    completion.setZero(config.sub_tasks, shape.columns());
    start.resize(config.memory_size, shape.batch);
  }
  int mission(Index column) const { return mission_of[static_cast<std::size_t>(column)]; }
};

}  // namespace wordgaze::model
