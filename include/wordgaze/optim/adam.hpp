#pragma once
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::optim {

/// Adam (Kingma and Ba, 2015) over a tree of parameters; equations (O1)-(O3) in docs/math.md.
template <nn::Tree P>
struct Adam {
  P mean, variance;  ///< moments of the gradient
  std::int64_t steps = 0;
  double mean_decay = 0.9, variance_decay = 0.999, epsilon = 1e-5;

  explicit Adam(const P& params) : mean(nn::zeros_like(params)), variance(nn::zeros_like(params)) {}

  /// One step with the gradient scale * grads; rate(path) is the learning rate of a leaf.
  template <class Rate>
  void step(P& params, const P& grads, Rate&& rate, double scale = 1) {
    begin_step();
    update(params, grads, rate, scale, {});
  }

  /// The same by parts, which may run at the same time: begin_step() once, then update() of each.
  void begin_step() { ++steps; }
  template <class Rate>
  void update(P& params, const P& grads, Rate&& rate, double scale, nn::Part part) {
    const double t = static_cast<double>(steps);
    const double mean_bias = 1 - std::pow(mean_decay, t);
    const double variance_bias = 1 - std::pow(variance_decay, t);
    nn::for_each_parameter(
        [&](const nn::Path& path, auto& weight, const auto& gradient, auto& first, auto& second) {
          using S = typename std::remove_cvref_t<decltype(weight)>::Scalar;
          auto w = part(weight).array(), m = part(first).array(), v = part(second).array();
          const auto g = static_cast<S>(scale) * part(gradient).array();
          const auto size = static_cast<S>(rate(path) / mean_bias);
          const auto root_bias = static_cast<S>(1 / std::sqrt(variance_bias));
          m += static_cast<S>(1 - mean_decay) * (g - m);
          v += static_cast<S>(1 - variance_decay) * (g.square() - v);
          w -= size * m / (v.sqrt() * root_bias + static_cast<S>(epsilon));
        },
        params, grads, mean, variance);
  }
};

}  // namespace wordgaze::optim
