#pragma once
#include <array>
#include <span>

#include "wordgaze/evaluation/mean.hpp"
#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::evaluation {

/// How a map shares its mass out to the roles of cells, and how an even map would.
struct Mass {
  std::array<Mean, kRoles> share, even;

  /// Adds a map of non-negative numbers, normalized to sum 1; one that is all zero is left out.
  void add(std::span<const float> map, const Roles& roles);
};

}  // namespace wordgaze::evaluation
