#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/linear.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Actor or critic: a hidden layer with tanh, then a linear output; equation (H) in docs/math.md.
///
/// shapes   x [in, N]   y [out, N]
/// backward accumulates into grads (+=), overwrites dx (=)
template <std::floating_point S>
struct Head {
  struct Params {
    typename nn::Linear<S>::Params hidden, output;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"hidden", &Params::hidden}, nn::Field{"output", &Params::output}};
    }
  };
  struct Cache {
    Matrix<S> hidden, dhidden;  // [head_size, N]
    void resize(Index hidden_size, Index frames) {
      for (auto* m : {&hidden, &dhidden}) m->resize(hidden_size, frames);
    }
  };

  static void resize(Index in, Index hidden, Index out, Params& p) {
    nn::Linear<S>::resize(in, hidden, p.hidden);
    nn::Linear<S>::resize(hidden, out, p.output);
  }
  static void forward(const Params& p, In<S> x, Cache& k, Out<S> y) {
    nn::Linear<S>::forward(p.hidden, x, {}, k.hidden);
    k.hidden = k.hidden.array().tanh();
    nn::Linear<S>::forward(p.output, k.hidden, {}, y);
  }
  static void backward(const Params& p, In<S> x, In<S> dy, Cache& k, Params& grads, Out<S> dx) {
    nn::Linear<S>::backward(p.output, k.hidden, dy, {}, grads.output, k.dhidden);
    k.dhidden.array() *= S(1) - k.hidden.array().square();
    nn::Linear<S>::backward(p.hidden, x, k.dhidden, {}, grads.hidden, dx);
  }
};

}  // namespace wordgaze::model
