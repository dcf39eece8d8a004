#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::nn {

/// y = W x + b; equation (L) in docs/math.md.
///
/// shapes   x [in, N]   y [out, N]
/// backward accumulates into grads (+=), overwrites dx (=)
template <std::floating_point S>
struct Linear {
  struct Params {
    Matrix<S> weight;  ///< [out, in]
    Vector<S> bias;    ///< [out]
    static constexpr auto fields() {
      return std::tuple{Field{"weight", &Params::weight}, Field{"bias", &Params::bias}};
    }
  };
  static void resize(Params& p, Index in, Index out) {
    p.weight.resize(out, in);
    p.bias.resize(out);
  }
  static void forward(const Params& p, In<S> x, Out<S> y) {
    y.noalias() = p.weight * x;
    y.colwise() += p.bias;
  }
  static void backward(const Params& p, In<S> x, In<S> dy, Params& grads, Out<S> dx) {
    backward_weights(x, dy, grads);
    dx.noalias() = p.weight.transpose() * dy;
  }
  /// For a first layer, whose input wants no gradient.
  static void backward_weights(In<S> x, In<S> dy, Params& grads) {
    grads.weight.noalias() += dy * x.transpose();
    grads.bias += dy.rowwise().sum();
  }
};

}  // namespace wordgaze::nn
