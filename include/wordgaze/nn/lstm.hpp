#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/parameters.hpp"
#include "wordgaze/nn/sequence.hpp"

namespace wordgaze::nn {

/// LSTM over whole sequences; equations (M1)-(M4) in docs/math.md, gates in the order i, f, g, o.
///
/// The product of input and input weight is the caller's: the agent's input is never formed as a
/// vector (model/table_vision.hpp).
///
/// shapes   product [4 hidden, T*B]  W_x x
///          keep [1, T*B]  0 where an episode begins at that column, else 1
///          h, cache.cell [hidden, T*B]
/// backward accumulates into grads (+=) hidden_weight and bias, input_weight is the caller's;
///          overwrites dproduct (=), the gradient of W_x x + W_h h + b
template <std::floating_point S>
struct Lstm {
  struct Params {
    Matrix<S> input_weight;   ///< [4 hidden, in]
    Matrix<S> hidden_weight;  ///< [4 hidden, hidden]
    Vector<S> bias;           ///< [4 hidden]
    static constexpr auto fields() {
      return std::tuple{Field{"input_weight", &Params::input_weight},
                        Field{"hidden_weight", &Params::hidden_weight},
                        Field{"bias", &Params::bias}};
    }
  };

  /// Memory between two steps; [hidden, B] each.
  struct State {
    Matrix<S> h, c;
    void resize(Index hidden, Index batch) {
      h.setZero(hidden, batch);
      c.setZero(hidden, batch);
    }
  };

  struct Cache {
    Matrix<S> gates, cell, cell_tanh, h_prev, c_prev;  // [.., T*B]
    Matrix<S> dh, dc;                                  // [hidden, B], scratch
    void resize(Index hidden, SequenceShape shape) {
      gates.resize(4 * hidden, shape.columns());
      for (auto* m : {&cell, &cell_tanh, &h_prev, &c_prev}) m->resize(hidden, shape.columns());
      for (auto* m : {&dh, &dc}) m->resize(hidden, shape.batch);
    }
  };

  static void resize(Index in, Index hidden, Params& p) {
    p.input_weight.resize(4 * hidden, in);
    p.hidden_weight.resize(4 * hidden, hidden);
    p.bias.resize(4 * hidden);
  }

  static void forward(const Params& p, SequenceShape shape, In<S> product, In<S> keep,
                      const State& start, Cache& k, Out<S> h) {
    const Index hidden = p.hidden_weight.cols();
    for (Index t = 0; t < shape.steps; ++t) {
      auto h_prev = shape.block(k.h_prev, t);
      auto c_prev = shape.block(k.c_prev, t);
      if (t == 0) {
        h_prev = start.h;
        c_prev = start.c;
      } else {
        h_prev = shape.block(h, t - 1);
        c_prev = shape.block(k.cell, t - 1);
      }
      const auto alive = shape.block(keep, t).row(0).array();
      h_prev.array().rowwise() *= alive;
      c_prev.array().rowwise() *= alive;

      auto z = shape.block(k.gates, t);
      z = shape.block(product, t);
      z.noalias() += p.hidden_weight * h_prev;
      z.colwise() += p.bias;
      auto i = z.topRows(hidden).array(), f = z.middleRows(hidden, hidden).array();
      auto g = z.middleRows(2 * hidden, hidden).array(), o = z.bottomRows(hidden).array();
      i = i.logistic();
      f = f.logistic();
      g = g.tanh();
      o = o.logistic();
      auto c = shape.block(k.cell, t).array();
      auto c_tanh = shape.block(k.cell_tanh, t).array();
      c = f * c_prev.array() + i * g;
      c_tanh = c.tanh();
      shape.block(h, t).array() = o * c_tanh;
    }
  }

  /// dh [hidden, T*B]: gradient of h from the layers above.
  static void backward(const Params& p, SequenceShape shape, In<S> keep, In<S> dh, Cache& k,
                       Params& grads, Out<S> dproduct) {
    const Index hidden = p.hidden_weight.cols();
    k.dh.setZero();
    k.dc.setZero();
    for (Index t = shape.steps - 1; t >= 0; --t) {
      k.dh += shape.block(dh, t);
      const auto z = shape.block(k.gates, t);
      const auto i = z.topRows(hidden).array(), f = z.middleRows(hidden, hidden).array();
      const auto g = z.middleRows(2 * hidden, hidden).array(), o = z.bottomRows(hidden).array();
      const auto c_tanh = shape.block(k.cell_tanh, t).array();
      auto dz = shape.block(dproduct, t);
      k.dc.array() += k.dh.array() * o * (S(1) - c_tanh.square());
      dz.topRows(hidden).array() = k.dc.array() * g * i * (S(1) - i);
      dz.middleRows(hidden, hidden).array() =
          k.dc.array() * shape.block(k.c_prev, t).array() * f * (S(1) - f);
      dz.middleRows(2 * hidden, hidden).array() = k.dc.array() * i * (S(1) - g.square());
      dz.bottomRows(hidden).array() = k.dh.array() * c_tanh * o * (S(1) - o);

      const auto alive = shape.block(keep, t).row(0).array();
      k.dc.array() *= f;
      k.dc.array().rowwise() *= alive;
      k.dh.noalias() = p.hidden_weight.transpose() * dz;
      k.dh.array().rowwise() *= alive;
    }
    grads.hidden_weight.noalias() += dproduct * k.h_prev.transpose();
    grads.bias += dproduct.rowwise().sum();
  }
};

}  // namespace wordgaze::nn
