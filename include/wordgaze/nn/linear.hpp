#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::nn {

/// y = W x + b; equation (L) in docs/math.md. The layer to imitate: docs/architecture.md has the
/// protocol of all of them.
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
  struct Cache {};  ///< nothing: backward is given x again

  static void resize(Index in, Index out, Params& p) {
    p.weight.resize(out, in);
    p.bias.resize(out);
  }
  static void forward(const Params& p, In<S> x, const Cache& /*k*/, Out<S> y) {
    y.noalias() = p.weight * x;
    y.colwise() += p.bias;
  }
  static void backward(const Params& p, In<S> x, In<S> dy, const Cache& /*k*/, Params& grads,
                       Out<S> dx) {
    grads.weight.noalias() += dy * x.transpose();
    grads.bias += dy.rowwise().sum();
    dx.noalias() = p.weight.transpose() * dy;
  }
};

}  // namespace wordgaze::nn
