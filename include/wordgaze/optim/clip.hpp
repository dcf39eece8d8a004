#pragma once
#include <cmath>

#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::optim {

/// Scales the whole gradient down to `limit` if its norm is larger; returns the norm before. A norm
/// that is not finite leaves the gradient alone: the caller must not use it.
template <nn::Tree P>
double clip_norm(P& grads, double limit) {
  const double norm = std::sqrt(nn::squared_norm(grads));
  if (std::isfinite(norm) && norm > limit) {
    nn::for_each_parameter(
        [&](const nn::Path&, auto& leaf) {
          using S = typename std::remove_cvref_t<decltype(leaf)>::Scalar;
          leaf *= static_cast<S>(limit / norm);
        },
        grads);
  }
  return norm;
}

}  // namespace wordgaze::optim
