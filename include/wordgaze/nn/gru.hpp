#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"
#include "wordgaze/nn/sequence.hpp"

namespace wordgaze::nn {

/// GRU over sequences of different lengths; equations (G1)-(G4) in docs/math.md, gates r, z, n.
/// Past its end a sequence keeps its state, so padding never leaks into the result.
///
/// The product of input and input weight is the caller's: words repeat, so it is a table over the
/// vocabulary.
///
/// shapes   product [3 hidden, T*B]  W_x x
///          active [1, T*B]  how far a step changes the state: 0 behind the end of a sequence, else
///          in
///                           (0, 1], as a rule 1
///          h [hidden, B]  the state after each whole sequence
///          A cache and dproduct may be larger than the batch: columns behind T*B are not touched.
/// backward accumulates into grads (+=) all but input_weight, which is the caller's; overwrites
///          dproduct (=), the gradient of W_x x
template <std::floating_point S>
struct Gru {
  struct Params {
    Matrix<S> input_weight;    ///< [3 hidden, in]
    Matrix<S> hidden_weight;   ///< [3 hidden, hidden]
    Vector<S> bias;            ///< [3 hidden], added to W_x x
    Vector<S> candidate_bias;  ///< [hidden], added to the candidate's W_h h, inside the reset gate
    static constexpr auto fields() {
      return std::tuple{Field{"input_weight", &Params::input_weight},
                        Field{"hidden_weight", &Params::hidden_weight},
                        Field{"bias", &Params::bias},
                        Field{"candidate_bias", &Params::candidate_bias}};
    }
  };

  struct Cache {
    Matrix<S> gates, h_prev, recurrent;  // recurrent: W_h h_prev (+ candidate bias)
    Matrix<S> dh, drecurrent;
    Matrix<S> dactive;  ///< [1, columns] after backward
    /// Grows to hold `columns`; batches of any shape up to that size then cost no allocation.
    void reserve(Index hidden, Index columns) {
      if (columns <= gates.cols()) return;
      for (auto* m : {&gates, &recurrent, &drecurrent}) m->resize(3 * hidden, columns);
      for (auto* m : {&h_prev, &dh}) m->resize(hidden, columns);
      dactive.resize(1, columns);
    }
  };

  static void resize(Index in, Index hidden, Params& p) {
    p.input_weight.resize(3 * hidden, in);
    p.hidden_weight.resize(3 * hidden, hidden);
    p.bias.resize(3 * hidden);
    p.candidate_bias.resize(hidden);
  }

  static void forward(const Params& p, SequenceShape shape, In<S> product, In<S> active, Cache& k,
                      Out<S> h) {
    const Index hidden = p.hidden_weight.cols();
    k.reserve(hidden, shape.columns());
    h.setZero();
    for (Index t = 0; t < shape.steps; ++t) {
      auto h_prev = shape.block(k.h_prev, t);
      h_prev = h;
      auto x = shape.block(k.gates, t);
      auto u = shape.block(k.recurrent, t);
      x = shape.block(product, t);
      x.colwise() += p.bias;
      u.noalias() = p.hidden_weight * h_prev;
      u.bottomRows(hidden).colwise() += p.candidate_bias;
      auto r = x.topRows(hidden).array(), z = x.middleRows(hidden, hidden).array();
      auto n = x.bottomRows(hidden).array();
      r = (r + u.topRows(hidden).array()).logistic();
      z = (z + u.middleRows(hidden, hidden).array()).logistic();
      n = (n + r * u.bottomRows(hidden).array()).tanh();
      h.array() = (S(1) - z) * (n - h_prev.array());  // what this step changes
      h.array().rowwise() *= shape.block(active, t).row(0).array();
      h += h_prev;
    }
  }

  /// dh_last [hidden, B]: gradient of h.
  static void backward(const Params& p, SequenceShape shape, In<S> active, In<S> dh_last, Cache& k,
                       Params& grads, Out<S> dproduct) {
    if (shape.columns() == 0) return;  // of sequences without steps nothing is cached
    const Index hidden = p.hidden_weight.cols();
    auto dh = k.dh.leftCols(shape.batch);
    dh = dh_last;
    for (Index t = shape.steps - 1; t >= 0; --t) {
      const auto x = shape.block(k.gates, t);
      const auto r = x.topRows(hidden).array(), z = x.middleRows(hidden, hidden).array();
      const auto n = x.bottomRows(hidden).array();
      const auto h_prev = shape.block(k.h_prev, t).array();
      const auto alive = shape.block(active, t).row(0).array();
      auto dx = shape.block(dproduct, t);
      auto du = shape.block(k.drecurrent, t);
      auto dn = dx.bottomRows(hidden).array();
      dn = dh.array() * (S(1) - z) * (S(1) - n.square());
      dn.rowwise() *= alive;
      dx.topRows(hidden).array() =
          dn * shape.block(k.recurrent, t).bottomRows(hidden).array() * r * (S(1) - r);
      auto dz = dx.middleRows(hidden, hidden).array();
      dz = dh.array() * (h_prev - n) * z * (S(1) - z);
      dz.rowwise() *= alive;
      du.topRows(2 * hidden) = dx.topRows(2 * hidden);
      du.bottomRows(hidden).array() = dn * r;
      // dh becomes dh_prev: through the update gate (all of it behind the end) and through W_h.
      shape.block(k.dactive, t) = (dh.array() * (S(1) - z) * (n - h_prev)).colwise().sum();
      dh.array() *= S(1) - (S(1) - z).rowwise() * alive;
      dh.noalias() += p.hidden_weight.transpose() * du;
    }
    const auto all = [&](const auto& m) { return m.leftCols(shape.columns()); };
    grads.hidden_weight.noalias() += all(k.drecurrent) * all(k.h_prev).transpose();
    grads.bias += all(dproduct).rowwise().sum();
    grads.candidate_bias += all(k.drecurrent).bottomRows(hidden).rowwise().sum();
  }
};

}  // namespace wordgaze::nn
