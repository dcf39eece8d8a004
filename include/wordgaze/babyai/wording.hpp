#pragma once
#include "wordgaze/babyai/meaning.hpp"
#include "wordgaze/babyai/sentence.hpp"

namespace wordgaze::babyai {

WordId word_of(grid::Type type);
WordId word_of(grid::Color color);

/// The sentence of an instruction, word by word as the reference writes it: "a" where several
/// objects are meant, else "the". (docs/simulator.md, Descriptions)
Sentence wording(const Instruction& instruction, const Meaning& meaning);

}  // namespace wordgaze::babyai
