#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"

/// Central differences against hand-written gradients. Public: whoever adds a layer needs it.
namespace wordgaze::nn {

struct GradientError {
  /// Largest |numeric - analytic| / max(|numeric|, |analytic|, 1e-3): relative, but for entries so
  /// small that the difference quotient itself is mostly rounding. NaN, whatever came after it,
  /// where either is not finite.
  double worst = 0;
  std::string where;  ///< "memory.hidden_weight[17]"
};

/// Compares `gradient` with central differences of `loss()` over every entry of `leaf`, which loss
/// reads. The step suits double precision.
template <class Leaf, class Gradient, class Loss>
void check_leaf(const std::string& name, Leaf& leaf, const Gradient& gradient, Loss&& loss,
                GradientError& error, double step = 1e-5) {
  for (Index i = 0; i < leaf.size(); ++i) {
    auto& entry = leaf.data()[i];
    const auto kept = entry;
    entry = kept + step;
    const double above = loss();
    entry = kept - step;
    const double below = loss();
    entry = kept;
    const double numeric = (above - below) / (2 * step), analytic = gradient.data()[i];
    const double difference =
        std::abs(numeric - analytic) / std::max({1e-3, std::abs(numeric), std::abs(analytic)});
    // The first NaN is the worst for good: no number compares with it.
    if (!std::isnan(error.worst) && !(difference <= error.worst)) {
      error.worst = difference;
      error.where = name + "[" + std::to_string(i) + "]";
    }
  }
}

/// The same over every leaf of a parameter tree but those for which fixed(path) holds: numbers that
/// are set, not learned.
template <Tree P, class Loss, class Fixed>
GradientError check_gradients(P& params, const P& grads, Loss&& loss, Fixed&& fixed,
                              double step = 1e-5) {
  GradientError error;
  for_each_parameter(
      [&](const Path& path, auto& leaf, const auto& gradient) {
        if (!fixed(path)) check_leaf(path.str(), leaf, gradient, loss, error, step);
      },
      params, grads);
  return error;
}
template <Tree P, class Loss>
GradientError check_gradients(P& params, const P& grads, Loss&& loss) {
  return check_gradients(params, grads, loss, [](const Path&) { return false; });
}

}  // namespace wordgaze::nn
