#pragma once
#include <span>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/evaluation/mean.hpp"

namespace wordgaze::evaluation {

/// The entropy weight w of content words against that of function words.
struct WordWeights {
  Mean content, function;  ///< of a word
  Mean content_share;      ///< of all content words together
  Mean even_share;         ///< and what it would be if all words weighed the same

  void add(std::span<const float> weights, const babyai::Sentence& sentence);
};

}  // namespace wordgaze::evaluation
