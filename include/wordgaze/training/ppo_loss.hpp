#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "wordgaze/grid/action.hpp"
#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::training {

/// The loss of one frame and its gradient; equations (P3)-(P6) in docs/math.md.
///
///     - min(r A, clip(r, 1 - eps, 1 + eps) A) + c_v (V - R)^2 - c_e entropy,   r = p / p_old
template <class S>
struct PpoLoss {
  S clip, value_coefficient, entropy_coefficient;

  struct Frame {
    std::size_t action;
    S old_log_prob, advantage, value_target;
  };
  /// Sums over frames, for the log; all but `frames` are to be divided by it.
  struct Sums {
    double policy = 0, value = 0, entropy = 0, divergence = 0, clipped = 0;
  };

  /// Adds `scale` times the gradient (1 / frames of the minibatch) to dlogits and dvalue (+=). The
  /// logits are those of the actions that are possible.
  void add(const Frame& frame, std::span<const S> logits, S value, S scale, std::span<S> dlogits,
           S& dvalue, Sums& sums) const {
    using C = nn::Categorical<S>;
    std::array<S, grid::kActions> numbers;
    const auto log_p = std::span(numbers).first(logits.size());
    C::log_softmax(logits, log_p);
    const S entropy = C::entropy(log_p);
    const S log_ratio = log_p[frame.action] - frame.old_log_prob;
    const S ratio = std::exp(log_ratio);
    const S free = ratio * frame.advantage;
    const S bound = std::clamp(ratio, S(1) - clip, S(1) + clip) * frame.advantage;
    const bool pulls = free <= bound;  // else the clipped, constant side is the smaller one

    if (pulls) C::add_log_prob_gradient(log_p, frame.action, -scale * free, dlogits);
    C::add_entropy_gradient(log_p, entropy, -scale * entropy_coefficient, dlogits);
    const S error = value - frame.value_target;
    dvalue += scale * value_coefficient * 2 * error;

    sums.policy -= static_cast<double>(std::min(free, bound));
    sums.value += static_cast<double>(error * error);
    sums.entropy += static_cast<double>(entropy);
    sums.divergence += static_cast<double>(ratio - 1 - log_ratio);
    sums.clipped += std::abs(ratio - 1) > clip ? 1 : 0;
  }
};

}  // namespace wordgaze::training
