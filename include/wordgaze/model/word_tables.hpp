#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// A word that every mission says silently, behind the vocabulary: what all words have in common.
inline constexpr int kSilentWord = babyai::kVocabularySize;

/// What attention knows of every word, as a vision compares it with the view.
///
/// With q = W_q g~ a score q . (W_k O~) / sqrt(d_k) is (W_k^T q / sqrt(d_k)) . O~, so keys need not
/// be formed: a word has a probe that is compared with the encodings themselves.
template <std::floating_point S>
struct WordTables {
  Matrix<S> queries;  ///< [d_k, V]; not as a gradient
  Matrix<S> probes;   ///< [C, V + 1]; the last column is the silent word's
  Matrix<S> choice;   ///< [1, V] positive: speaks of types; negative: of colors
  S focus = 1;        ///< in [0, 1]: how far the gaze has focused; not as a gradient
  S sharpness = 1;    ///< beta, inverse temperature of the maps; not as a gradient
  static constexpr auto fields() {
    return std::tuple{nn::Field{"probes", &WordTables::probes},
                      nn::Field{"choice", &WordTables::choice}};
  }
};

}  // namespace wordgaze::model
