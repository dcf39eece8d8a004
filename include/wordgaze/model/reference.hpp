#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>

#include "wordgaze/core/types.hpp"
#include "wordgaze/model/agent.hpp"

namespace wordgaze::model {

/// The network written a second time, as docs/math.md has it and the paper's text reads: one-hot
/// cells, all 49 of them, one frame and one word at a time, no tables, no shortcut and no gradient.
/// Slow. For reading, and for tests to hold Agent against.
template <std::floating_point S>
struct ReferenceAgent {
  const Design& design;
  const typename Agent<S>::Params& params;

  static Vector<S> logistic(const Vector<S>& v) { return 1 / (1 + (-v.array()).exp()); }

  /// (G1)-(G4): the text feature u [G] of a mission.
  Vector<S> text(const babyai::Sentence& mission) const {
    const auto& p = params.text;
    const Index g = p.hidden_weight.cols();
    Vector<S> h = Vector<S>::Zero(g);
    for (const auto word : mission) {
      const Vector<S> x = p.input_weight * params.words.col(word) + p.bias;
      const Vector<S> u = p.hidden_weight * h;
      const Vector<S> r = logistic(x.head(g) + u.head(g));
      const Vector<S> z = logistic(x.segment(g, g) + u.segment(g, g));
      const Vector<S> n =
          (x.tail(g).array() + r.array() * (u.tail(g) + p.candidate_bias).array()).tanh();
      h = (1 - z.array()) * n.array() + z.array() * h.array();
    }
    return h;
  }

  /// A convolution with square kernels of 1x1 or 3x3, zeros around the view, then the leaky ReLU.
  Matrix<S> convolve(const Matrix<S>& weight, const Vector<S>& bias, const Matrix<S>& view) const {
    const Index in = view.rows(), reach = weight.cols() == in ? 0 : 1;
    const Index side = grid::kViewSize;
    Matrix<S> out(weight.rows(), grid::kViewCells);
    for (Index a = 0; a < side; ++a) {
      for (Index b = 0; b < side; ++b) {
        Vector<S> sum = bias;
        Index tap = 0;
        for (Index da = -reach; da <= reach; ++da) {
          for (Index db = -reach; db <= reach; ++db, ++tap) {
            if (a + da < 0 || a + da >= side || b + db < 0 || b + db >= side) continue;
            sum += weight.middleCols(tap * in, in) * view.col((a + da) * side + b + db);
          }
        }
        out.col(a * side + b) = sum.cwiseMax(static_cast<S>(design.config.encoder_leak) * sum);
      }
    }
    return out;
  }

  /// (V)-(V3): the visual encoding O~ [C, 49] of a frame.
  Matrix<S> encode(const Frames<S>& x, Index n) const {
    Matrix<S> view = Matrix<S>::Zero(kCellFeatures, grid::kViewCells);
    for (Index cell = 0; cell < grid::kViewCells; ++cell) {
      for (const int row : features(design.alphabet[x.cells(cell, n)])) view(row, cell) = 1;
    }
    const auto& [cells, patches] = params.vision;
    if (design.config.encoder == Encoder::cell) return convolve(cells.weight, cells.bias, view);
    return convolve(patches.second.weight, patches.second.bias,
                    convolve(patches.first.weight, patches.first.bias, view));
  }

  /// Where a frame's mission looks.
  struct Attention {
    Matrix<S> maps;     ///< A [words, 49]
    Vector<S> weights;  ///< w [words]
    Vector<S> mask;     ///< alpha [words]; ones without the Task Attention Module
    Vector<S> gaze;     ///< M [49]
    Vector<S> scale;    ///< s(M) [49]; all there is without attention, ones
  };

  /// (A1)-(A6) and (T1)-(T3).
  Attention attend(const Frames<S>& x, Index n, const Matrix<S>& encoding,
                   const babyai::Sentence& mission) const {
    const Config& c = design.config;
    Attention a;
    a.scale.setOnes(grid::kViewCells);
    if (!c.attention) return a;
    a.maps.resize(mission.length, grid::kViewCells);
    Vector<S> entropy(mission.length);
    for (int i = 0; i < mission.length; ++i) {
      const auto word = mission.words[static_cast<std::size_t>(i)];
      const Vector<S> q = params.attention.query * params.words.col(word);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const Vector<S> k = params.attention.key * encoding.col(cell);
        a.maps(i, cell) = std::exp(q.dot(k) / std::sqrt(static_cast<S>(c.key_size)));
      }
      a.maps.row(i) /= a.maps.row(i).sum();
      entropy(i) = -(a.maps.row(i).array() * a.maps.row(i).array().log()).sum() /
                   std::log(static_cast<S>(c.entropy_base));
    }
    a.weights = (-entropy.array()).exp();
    a.weights /= a.weights.sum();
    a.mask = c.task_attention ? mask(x, n, a.weights, mission) : Vector<S>::Ones(mission.length);
    a.gaze = a.maps.transpose() * (a.mask.array() * a.weights.array()).matrix();
    const auto floor = static_cast<S>(c.gaze_floor);
    a.scale =
        floor +
        (1 - floor) *
            (a.gaze.array() / (a.gaze.maxCoeff() + S(1e-6))).pow(static_cast<S>(c.gaze_exponent));
    return a;
  }

  /// (T1)-(T3): alpha, a number a word.
  Vector<S> mask(const Frames<S>& x, Index n, const Vector<S>& w,
                 const babyai::Sentence& mission) const {
    const Config& c = design.config;
    const auto& p = params.task;
    Vector<S> in = Vector<S>::Zero(p.hidden.weight.cols());
    for (int i = 0; i < mission.length; ++i) {
      const Index row = c.task_reader == Reader::places ? i * c.word_size : 0;
      in.segment(row, c.word_size) +=
          w(i) * params.words.col(mission.words[static_cast<std::size_t>(i)]);
    }
    in.tail(c.sub_tasks) = x.completion.col(n);
    const Vector<S> hidden = (p.hidden.weight * in + p.hidden.bias).cwiseMax(0);
    const Vector<S> alpha = logistic(p.output.weight * hidden + p.output.bias);
    return alpha.head(mission.length);
  }

  /// (M1)-(M4) and (H). The mask of words behind the end of a mission is 1.
  Outputs<S> run(const Frames<S>& x, const Missions& missions) const {
    const Config& c = design.config;
    const Index hidden = c.memory_size;
    Outputs<S> out;
    out.resize(c, x.shape.columns());
    out.mask.setOnes();
    for (Index b = 0; b < x.shape.batch; ++b) {
      Vector<S> h = x.start.h.col(b), memory = x.start.c.col(b);
      for (Index t = 0; t < x.shape.steps; ++t) {
        const Index n = x.shape.column(t, b);
        if (x.keep(0, n) == 0) h.setZero(), memory.setZero();
        const auto& mission = missions[x.mission(n)];
        const Matrix<S> encoding = encode(x, n);
        const Attention attention = attend(x, n, encoding, mission);
        if (c.task_attention) out.mask.col(n).head(mission.length) = attention.mask;
        const Matrix<S> filtered = encoding * attention.scale.asDiagonal();
        const auto& m = params.memory;
        Vector<S> z = m.input_weight * filtered.reshaped() + m.hidden_weight * h + m.bias;
        if (c.completion_input) z += params.completion * x.completion.col(n);
        memory = logistic(z.segment(hidden, hidden)).array() * memory.array() +
                 logistic(z.head(hidden)).array() * z.segment(2 * hidden, hidden).array().tanh();
        h = logistic(z.tail(hidden)).array() * memory.array().tanh();
        Vector<S> features(hidden + c.text_size);
        features << h, text(mission);
        const auto head = [&](const auto& p) -> Vector<S> {
          return p.output.weight *
                     (p.hidden.weight * features + p.hidden.bias).array().tanh().matrix() +
                 p.output.bias;
        };
        out.logits.col(n) = head(params.actor);
        out.values.col(n) = head(params.critic);
      }
    }
    return out;
  }
};

}  // namespace wordgaze::model
