#pragma once
#include <array>
#include <span>

#include "wordgaze/evaluation/mean.hpp"
#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::evaluation {

/// How a map shares its mass out to the roles of cells, and how an even map would.
struct Mass {
  std::array<Mean, kRoles> share, even;
  Mean nowhere;

  /// Adds a map of non-negative numbers and what lies on nowhere, normalized to sum 1 together; one
  /// that is all zero is left out.
  void add(std::span<const float> map, const Roles& roles, double on_nowhere = 0);
};

/// How bright the brightest object of a map is, each a number in [0, 1].
struct Glow {
  Mean brightest;  ///< of the objects in view; decisions with none are left out
  Mean over_half;  ///< how often it is above 1/2

  void add(std::span<const float> map, const Roles& roles);
};

}  // namespace wordgaze::evaluation
