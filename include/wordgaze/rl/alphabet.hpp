#pragma once
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/model/cell_alphabet.hpp"

namespace wordgaze::rl {

/// The smallest alphabet that holds every cell a level can show. Weights do not depend on it.
inline model::CellAlphabet alphabet_of(const babyai::LevelSpec& level) {
  const bool one_room =
      level.rows == 1 && level.columns == 1 && level.rule == babyai::Rule::instruction;
  return one_room ? model::CellAlphabet::one_room() : model::CellAlphabet::everything();
}

}  // namespace wordgaze::rl
