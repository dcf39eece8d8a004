#pragma once
#include <algorithm>
#include <optional>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/grid/cell.hpp"

namespace wordgaze::evaluation {

/// The color that a word names, if it names one.
inline std::optional<grid::Color> color_of(babyai::WordId word) {
  const auto found =
      std::find(grid::kColorNames.begin(), grid::kColorNames.end(), babyai::word(word));
  if (found == grid::kColorNames.end()) return std::nullopt;
  return static_cast<grid::Color>(found - grid::kColorNames.begin());
}

/// The type of object that a word names: key, ball, box or door.
inline std::optional<grid::Type> type_of(babyai::WordId word) {
  for (const auto type : {grid::Type::key, grid::Type::ball, grid::Type::box, grid::Type::door}) {
    if (babyai::word(word) == grid::name(type)) return type;
  }
  return std::nullopt;
}

/// Content words name a color or a type; all others, verbs too, are function words.
inline bool is_content(babyai::WordId word) { return color_of(word) || type_of(word); }

}  // namespace wordgaze::evaluation
