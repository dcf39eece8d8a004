#pragma once
#include <cmath>
#include <numbers>
#include <type_traits>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"

/// Ways to fill a matrix at random.
namespace wordgaze::nn {

/// Entries uniform in [-limit, limit].
template <class M>
void fill_uniform(M&& leaf, double limit, core::Rng& rng) {
  for (Index i = 0; i < leaf.size(); ++i) {
    leaf.data()[i] = static_cast<typename std::decay_t<M>::Scalar>(limit * (2 * rng.uniform() - 1));
  }
}

/// Uniform entries of variance gain^2 / fan-in: keeps the size of a signal.
template <class M>
void fill_scaled(M& leaf, double gain, core::Rng& rng) {
  fill_uniform(leaf, gain * std::sqrt(3.0 / static_cast<double>(leaf.cols())), rng);
}

/// Standard normal entries (Box-Muller).
template <class M>
void fill_normal(M&& leaf, core::Rng& rng) {
  for (Index i = 0; i < leaf.size(); ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - rng.uniform()));
    leaf.data()[i] = static_cast<typename std::decay_t<M>::Scalar>(
        radius * std::cos(2 * std::numbers::pi * rng.uniform()));
  }
}

}  // namespace wordgaze::nn
