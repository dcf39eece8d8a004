#pragma once
#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/model/config.hpp"

namespace wordgaze::model {

/// What the blocks of a network are made from: its settings, and the codes that a view can show.
struct Design {
  Config config{};
  CellAlphabet alphabet = CellAlphabet::everything();
};

}  // namespace wordgaze::model
