#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/evaluation/mean.hpp"
#include "wordgaze/evaluation/roles.hpp"
#include "wordgaze/policy/policy.hpp"

namespace wordgaze::evaluation {

/// The brightest cell of a map; of equally bright ones the first.
std::size_t brightest(std::span<const float> map);

/// The pointing game: does the brightest cell of a map hold what the mission is about? Counted
/// where such an object is in view. Beside it the chance that a random object in view would have
/// been one.
struct Pointing {
  Mean target, target_chance;  ///< an object of a sub-task whose turn it is
  Mean named, named_chance;    ///< an object of any sub-task

  void add(std::span<const float> map, const Roles& roles);
  /// Adds M of a policy's decision; nothing without attention.
  void add(const policy::Policy& policy, int lane,
           std::span<const std::uint8_t, grid::kImageBytes> image,
           const babyai::Progress& progress);
  void operator+=(const Pointing& o) {
    target += o.target;
    target_chance += o.target_chance;
    named += o.named;
    named_chance += o.named_chance;
  }
};

/// The pointing game of single words: does the brightest cell of a color's map hold an object of
/// that color, and of a type's map one of that type? Counted where one is in view.
struct WordPointing {
  Mean color, type;

  /// `maps` holds 49 numbers a word, row by row.
  void add(std::span<const float> maps, const babyai::Sentence& sentence,
           std::span<const std::uint8_t, grid::kImageBytes> image);
};

}  // namespace wordgaze::evaluation
