#pragma once
#include <cstdint>
#include <string_view>

#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {

/// A random policy that gets about: it walks on, opens doors, picks things up and, where that
/// counts, declares what it has done. Its own stream, equal for equal ids and seeds on every
/// machine.
class RandomPolicy {
 public:
  RandomPolicy(std::string_view id, std::uint64_t seed, std::uint64_t policy_seed = 0);

  grid::Action operator()(const Environment& env);

  /// Draws 0 to 99 from its stream, for a policy that falls back on this one.
  int percent() { return below(100); }

 private:
  std::uint64_t next();
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  grid::Action turn() { return below(2) == 0 ? grid::Action::left : grid::Action::right; }
  grid::Action choose(const Environment& env);

  std::uint64_t state_;
};

}  // namespace wordgaze::env
