#pragma once
#include "wordgaze/nn/linear.hpp"

namespace wordgaze::model {

/// The Task Attention Module; equations (T1)-(T3) in docs/math.md. An MLP that reads the weighted
/// words and the completion vector c_t and gives one number in (0, 1) a word: the mask alpha, which
/// silences the words of finished sub-tasks.
///
/// shapes   x [E + clauses, N]: sum_i w_i e_i (or each w_i e_i in its place) over c_t
///          alpha [task_words, N]
/// backward accumulates into grads (+=), writes cache.dx
template <std::floating_point S>
struct TaskAttention {
  struct Params {
    typename nn::Linear<S>::Params hidden, output;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"hidden", &Params::hidden}, nn::Field{"output", &Params::output}};
    }
  };
  struct Cache {
    Matrix<S> x, hidden, alpha, dlogits, dhidden, dx;
    void resize(Index in, Index hidden_size, Index words, Index frames) {
      x.resize(in, frames);
      dx.resize(in, frames);
      for (auto* m : {&hidden, &dhidden}) m->resize(hidden_size, frames);
      for (auto* m : {&alpha, &dlogits}) m->resize(words, frames);
    }
  };
  static void forward(const Params& p, Cache& k) {
    nn::Linear<S>::forward(p.hidden, k.x, k.hidden);
    k.hidden = k.hidden.cwiseMax(S(0));
    nn::Linear<S>::forward(p.output, k.hidden, k.alpha);
    k.alpha = k.alpha.array().logistic();
  }
  /// On entry cache.dlogits holds what the mask loss asks of the logits before the sigmoid; dalpha
  /// is what the gaze asks of alpha.
  static void backward(const Params& p, In<S> dalpha, Cache& k, Params& grads) {
    k.dlogits.array() += dalpha.array() * k.alpha.array() * (S(1) - k.alpha.array());
    nn::Linear<S>::backward(p.output, k.hidden, k.dlogits, grads.output, k.dhidden);
    k.dhidden.array() *= (k.hidden.array() > S(0)).template cast<S>();
    nn::Linear<S>::backward(p.hidden, k.x, k.dhidden, grads.hidden, k.dx);
  }
};

}  // namespace wordgaze::model
