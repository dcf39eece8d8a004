#pragma once
#include <string>

#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::nn {

/// The path of the first leaf for which `is` holds, as "memory.bias"; empty where it holds for
/// none.
template <Tree P, class Is>
std::string first_leaf(const P& p, Is&& is) {
  std::string found;
  for_each_parameter(
      [&](const Path& path, const auto& leaf) {
        if (found.empty() && is(leaf)) found = path.str();
      },
      p);
  return found;
}

/// The path of the first leaf that holds NaN or an infinity; empty where all numbers are finite.
template <Tree P>
std::string first_not_finite(const P& p) {
  return first_leaf(p, [](const auto& leaf) { return !leaf.allFinite(); });
}

}  // namespace wordgaze::nn
