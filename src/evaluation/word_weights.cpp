#include "wordgaze/evaluation/word_weights.hpp"

#include "words.hpp"

namespace wordgaze::evaluation {

void WordWeights::add(std::span<const float> weights, const babyai::Sentence& sentence) {
  if (sentence.length == 0) return;
  double weight = 0;
  int words = 0;
  for (int i = 0; i < sentence.length; ++i) {
    const double w = weights[static_cast<std::size_t>(i)];
    if (is_content(sentence.words[static_cast<std::size_t>(i)])) {
      content.add(w);
      weight += w;
      ++words;
    } else {
      function.add(w);
    }
  }
  content_share.add(weight);
  even_share.add(static_cast<double>(words) / sentence.length);
}

}  // namespace wordgaze::evaluation
