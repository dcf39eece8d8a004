#pragma once
#include "wordgaze/nn/linear.hpp"

namespace wordgaze::model {

/// Actor or critic: a hidden layer with tanh, then a linear output; equation (H) in docs/math.md.
///
/// shapes   x [in, N]   cache.output [out, N]
/// backward accumulates into grads (+=), adds to dx (+=): both heads read the same features
template <std::floating_point S>
struct Head {
  struct Params {
    typename nn::Linear<S>::Params hidden, output;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"hidden", &Params::hidden}, nn::Field{"output", &Params::output}};
    }
  };
  struct Cache {
    Matrix<S> hidden, output, dhidden;
    void resize(Index hidden_size, Index out, Index frames) {
      for (auto* m : {&hidden, &dhidden}) m->resize(hidden_size, frames);
      output.resize(out, frames);
    }
  };
  static void resize(Params& p, Index in, Index hidden, Index out) {
    nn::Linear<S>::resize(p.hidden, in, hidden);
    nn::Linear<S>::resize(p.output, hidden, out);
  }
  static void forward(const Params& p, In<S> x, Cache& k) {
    nn::Linear<S>::forward(p.hidden, x, k.hidden);
    k.hidden = k.hidden.array().tanh();
    nn::Linear<S>::forward(p.output, k.hidden, k.output);
  }
  static void backward(const Params& p, In<S> x, In<S> doutput, Cache& k, Params& grads,
                       Out<S> dx) {
    nn::Linear<S>::backward(p.output, k.hidden, doutput, grads.output, k.dhidden);
    k.dhidden.array() *= S(1) - k.hidden.array().square();
    nn::Linear<S>::backward_weights(x, k.dhidden, grads.hidden);
    dx.noalias() += p.hidden.weight.transpose() * k.dhidden;
  }
};

}  // namespace wordgaze::model
