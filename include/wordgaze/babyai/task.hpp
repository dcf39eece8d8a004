#pragma once
#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/grid/object.hpp"

namespace wordgaze::babyai {

/// What an episode asks for.
struct Task {
  Instruction instruction;  ///< BabyAI's levels; without clauses in MiniGrid's own
  Sentence sentence;
  int max_steps = 0;
  grid::ObjectId target = grid::kNothing;  ///< what the rule of a MiniGrid level is about
};

}  // namespace wordgaze::babyai
