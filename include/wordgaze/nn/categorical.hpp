#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace wordgaze::nn {

/// A categorical distribution over a few choices, from its logits; equations (C1)-(C3) in
/// docs/math.md. Works on spans of one column: there are seven actions.
template <class S>
struct Categorical {
  /// log_p may alias logits.
  static void log_softmax(std::span<const S> logits, std::span<S> log_p) {
    S peak = logits[0];
    for (const S z : logits) peak = std::max(peak, z);
    S sum = 0;
    for (const S z : logits) sum += std::exp(z - peak);
    const S log_sum = peak + std::log(sum);
    for (std::size_t a = 0; a < logits.size(); ++a) log_p[a] = logits[a] - log_sum;
  }
  static S entropy(std::span<const S> log_p) {
    S h = 0;
    for (const S l : log_p) h -= std::exp(l) * l;
    return h;
  }
  /// Adds scale * d entropy / d logits.
  static void add_entropy_gradient(std::span<const S> log_p, S entropy, S scale,
                                   std::span<S> dlogits) {
    for (std::size_t a = 0; a < log_p.size(); ++a) {
      dlogits[a] -= scale * std::exp(log_p[a]) * (log_p[a] + entropy);
    }
  }
  /// Adds scale * d log p(choice) / d logits.
  static void add_log_prob_gradient(std::span<const S> log_p, std::size_t choice, S scale,
                                    std::span<S> dlogits) {
    for (std::size_t a = 0; a < log_p.size(); ++a) dlogits[a] -= scale * std::exp(log_p[a]);
    dlogits[choice] += scale;
  }
  /// The choice at quantile u in [0, 1).
  static std::size_t sample(std::span<const S> log_p, S u) {
    S cumulative = 0;
    for (std::size_t a = 0; a + 1 < log_p.size(); ++a) {
      cumulative += std::exp(log_p[a]);
      if (u < cumulative) return a;
    }
    return log_p.size() - 1;
  }
  static std::size_t greedy(std::span<const S> logits) {
    std::size_t best = 0;
    for (std::size_t a = 1; a < logits.size(); ++a) {
      if (logits[a] > logits[best]) best = a;
    }
    return best;
  }
};

}  // namespace wordgaze::nn
