#pragma once
#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/babyai/meaning.hpp"
#include "wordgaze/babyai/sentence.hpp"

namespace wordgaze::babyai {

/// What the rule of a MiniGrid level is about; each rule says what it uses.
struct Target {
  grid::ObjectId object = grid::kNothing, other = grid::kNothing;
  grid::Position place{}, trap{};
};

/// What an episode asks for.
struct Task {
  Instruction instruction{};  ///< without clauses in MiniGrid's own levels
  Meaning meaning{};
  Sentence sentence{};
  Target target{};
  int max_steps = 0;
  /// What the agent carries from the start, taken off the floor after the first view.
  grid::ObjectId start_carrying = grid::kNothing;
};

}  // namespace wordgaze::babyai
