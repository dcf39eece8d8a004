#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "wordgaze/core/types.hpp"
#include "wordgaze/model/agent.hpp"
#include "wordgaze/model/lexicon.hpp"

namespace wordgaze::model {

/// The network written a second time, as docs/math.md has it and the paper's text reads: one-hot
/// cells, all 49 of them, one frame and one word at a time, no tables, no shortcut and no gradient.
/// Slow. For reading, and for tests to hold Agent against.
template <std::floating_point S>
struct ReferenceAgent {
  const Design& design;
  const typename Agent<S>::Params& params;

  static Vector<S> logistic(const Vector<S>& v) { return 1 / (1 + (-v.array()).exp()); }

  /// (G1)-(G4): the text feature u [G] of a mission, its words as bright as `mask` says.
  Vector<S> text(const babyai::Sentence& mission, const Vector<S>& mask) const {
    const auto& p = params.text;
    const Index g = p.hidden_weight.cols();
    Vector<S> h = Vector<S>::Zero(g);
    for (Index j = 0; j < mission.length; ++j) {
      const auto word = mission.words[static_cast<std::size_t>(j)];
      const Vector<S> x = p.input_weight * params.words.col(word) + p.bias;
      const Vector<S> u = p.hidden_weight * h;
      const Vector<S> r = logistic(x.head(g) + u.head(g));
      const Vector<S> z = logistic(x.segment(g, g) + u.segment(g, g));
      const Vector<S> n =
          (x.tail(g).array() + r.array() * (u.tail(g) + p.candidate_bias).array()).tanh();
      h.array() += mask(j) * (1 - z.array()) * (n - h).array();
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

  /// (V): of a cell that holds this code.
  Vector<S> encode(const CellAlphabet::Code& code) const {
    Vector<S> one_hot = Vector<S>::Zero(kCellFeatures);
    for (const int row : features(code)) one_hot(row) = 1;
    const auto& p = params.vision.cells;
    const Vector<S> y = p.weight * one_hot + p.bias;
    return y.cwiseMax(static_cast<S>(design.config.encoder_leak) * y);
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

  /// Where a frame's mission looks. In the product, a column or entry more: nowhere.
  struct Attention {
    Matrix<S> maps;     ///< A [words, 49]
    Vector<S> weights;  ///< w [words]
    Vector<S> mask;     ///< alpha [words]; ones without the Task Attention Module
    Vector<S> gaze;     ///< M [49]
    Vector<S> scale;    ///< s(M) [49]; all there is without attention, ones
  };

  /// What a word scores on what can lie in a cell: q . K / sqrt(d_k).
  S raw_score(babyai::WordId word, const Vector<S>& encoding) const {
    const Vector<S> q = params.attention.query * params.words.col(word);
    const Vector<S> k = params.attention.key * encoding;
    return q.dot(k) / std::sqrt(static_cast<S>(design.config.key_size));
  }

  /// What two codes have in common: their type (attribute 0) or their color.
  static bool alike(int attribute, const CellAlphabet::Code& a, const CellAlphabet::Code& b) {
    return attribute == 0 ? a.type == b.type : a.color == b.color;
  }

  /// (A8): what the word says of an attribute, for each code of the alphabet.
  Vector<S> effect(int attribute, babyai::WordId word) const {
    const CellAlphabet& codes = design.alphabet;
    const auto is_object = [&](int p) { return Lexicon<S>::is_object(codes[p]); };
    Vector<S> raw(codes.size());
    for (int p = 0; p < codes.size(); ++p) raw(p) = raw_score(word, encode(codes[p]));
    const auto mean = [&](auto&& counts) {
      S sum = 0, n = 0;
      for (int p = 0; p < codes.size(); ++p) {
        if (!is_object(p) || !counts(codes[p])) continue;
        sum += raw(p);
        n += 1;
      }
      return sum / n;
    };
    Vector<S> e = Vector<S>::Zero(codes.size());
    for (int p = 0; p < codes.size(); ++p) {
      if (!is_object(p)) continue;
      e(p) = mean([&](const auto& other) { return alike(attribute, other, codes[p]); }) -
             mean([](const auto&) { return true; });
    }
    return e;
  }
  /// What the objects of the alphabet look like in the mean.
  Vector<S> mean_object() const {
    Vector<S> sum = Vector<S>::Zero(design.config.channels);
    S objects = 0;
    for (int p = 0; p < design.alphabet.size(); ++p) {
      if (!Lexicon<S>::is_object(design.alphabet[p])) continue;
      sum += encode(design.alphabet[p]);
      objects += 1;
    }
    return sum / objects;
  }

  /// (A9)-(A11): the scores of a word on each code of the alphabet and, last, on nowhere.
  Vector<S> spoken(babyai::WordId word) const {
    const Config& c = design.config;
    const S slope = static_cast<S>(c.word_choice_start) *
                    std::pow(static_cast<S>(c.word_choice / c.word_choice_start), focus());
    const S of_type = S(1) / (S(1) + std::exp(-slope * params.attention.words(0, word)));
    const Vector<S> said = of_type * effect(0, word) + (1 - of_type) * effect(1, word);
    Vector<S> scores(said.size() + 1);
    scores << said, static_cast<S>(c.nowhere) * said.maxCoeff();
    return scores;
  }
  S focus() const { return params.attention.focus(0); }

  /// (A1)-(A6) and (T1)-(T10).
  Attention attend(const Frames<S>& x, Index n, const Matrix<S>& encoding,
                   const babyai::Sentence& mission) const {
    const Config& c = design.config;
    Attention a;
    a.scale.setOnes(grid::kViewCells);
    if (!c.attention) return a;
    const bool product = c.gaze == Gaze::product;
    const Index places = grid::kViewCells + (product ? 1 : 0);
    a.maps.resize(mission.length, places);
    const S beta = product ? static_cast<S>(c.sharpness_start) *
                                 std::pow(static_cast<S>(c.sharpness / c.sharpness_start), focus())
                           : S(1);
    Vector<S> entropy(mission.length);
    for (int i = 0; i < mission.length; ++i) {
      const auto word = mission.words[static_cast<std::size_t>(i)];
      const Vector<S> by_code = product ? spoken(word) : Vector<S>();
      for (Index place = 0; place < places; ++place) {
        const S score = !product                   ? raw_score(word, encoding.col(place))
                        : place < grid::kViewCells ? by_code(x.cells(place, n))
                                                   : by_code(by_code.size() - 1);
        a.maps(i, place) = beta * score;
      }
      a.maps.row(i) = (a.maps.row(i).array() - a.maps.row(i).maxCoeff()).exp();
      a.maps.row(i) /= a.maps.row(i).sum();
      entropy(i) = 0;
      for (Index place = 0; place < places; ++place) {
        const S p = a.maps(i, place);
        if (p > S(0)) entropy(i) -= p * std::log(p) / std::log(static_cast<S>(c.entropy_base));
      }
    }
    a.weights = (-entropy.array()).exp();
    a.weights /= a.weights.sum();
    a.mask = c.task_attention ? mask(x, n, a.weights, mission) : Vector<S>::Ones(mission.length);
    const Vector<S> mix = a.mask.array() * a.weights.array();
    const auto floor = static_cast<S>(c.gaze_floor);
    if (!product) {
      a.gaze = a.maps.transpose() * mix;
      a.scale =
          floor +
          (1 - floor) *
              (a.gaze.array() / (a.gaze.maxCoeff() + S(1e-6))).pow(static_cast<S>(c.gaze_exponent));
      return a;
    }
    a.gaze = a.maps.array().log().matrix().transpose() * mix / (mix.sum() + S(1e-6));
    for (Index cell = 0; cell < grid::kViewCells; ++cell) {
      a.gaze(cell) += params.attention.silent.dot(encoding.col(cell));
    }
    a.gaze(grid::kViewCells) += params.attention.silent.dot(mean_object());
    a.gaze = (a.gaze.array() - a.gaze.maxCoeff()).exp();
    a.gaze /= a.gaze.sum();
    const auto cells = a.gaze.head(grid::kViewCells).array();
    a.scale = floor + (1 - floor) * cells / (cells + a.gaze(grid::kViewCells));
    return a;
  }

  /// (T1)-(T3) or (T4)-(T10): alpha, a number a word.
  Vector<S> mask(const Frames<S>& x, Index n, const Vector<S>& w,
                 const babyai::Sentence& mission) const {
    const Config& c = design.config;
    if (scans(c)) return scan(x.completion.col(n), mission);
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

  /// (T4)-(T10), written from the words' point of view: each looks at all others.
  Vector<S> scan(const Vector<S>& completion, const babyai::Sentence& mission) const {
    const auto& p = params.task.scan;
    const Index m = mission.length;
    const auto gate = [&](Index row, Index j) {
      const S x = p.words(row, mission.words[static_cast<std::size_t>(j)]);
      return 1 / (1 + std::exp(-x));
    };
    // Where each word is in the completion vector, and whether its sub-task is undone.
    Matrix<S> place = Matrix<S>::Zero(completion.size() + 1, m);
    Vector<S> undone(m), before(m), held(m), behind(m), turned(m), logits(m);
    for (Index j = 0; j < m; ++j) {
      const S move = gate(0, j);
      Vector<S> last = Vector<S>::Unit(place.rows(), 0);
      if (j > 0) last = place.col(j - 1);
      place.col(j) = (1 - move) * last;
      place.col(j).tail(place.rows() - 1) += move * last.head(place.rows() - 1);
      undone(j) = 1 - place.col(j).head(completion.size()).dot(completion);
      const S left = j > 0 ? before(j - 1) : S(0), left_held = j > 0 ? held(j - 1) : S(0);
      const S left_undone = j > 0 ? undone(j - 1) : S(0);
      before(j) = (1 - gate(2, j)) * (1 - (1 - left) * (1 - move * left_undone));
      const S unturned = 1 - (1 - left) * (1 - move * left_undone);
      held(j) = (1 - gate(2, j)) *
                ((1 - gate(1, j)) * left_held + gate(1, j) * (1 - gate(2, j)) * unturned);
    }
    for (Index j = m - 1; j >= 0; --j) {
      const bool last = j == m - 1;
      turned(j) = last ? S(0) : 1 - (1 - turned(j + 1)) * (1 - gate(2, j + 1) * behind(j + 1));
      behind(j) = last ? undone(j) : 1 - (1 - behind(j + 1)) * (1 - undone(j));
      logits(j) = p.words(3, mission.words[static_cast<std::size_t>(j)]) -
                  p.rules(0) * (1 - undone(j)) - p.rules(1) * held(j) - p.rules(2) * turned(j);
    }
    return logistic(logits);
  }

  /// (M1)-(M4) and (H). The mask of words behind the end of a mission is 1, that of a scan 0.
  Outputs<S> run(const Frames<S>& x, const Missions& missions) const {
    const Config& c = design.config;
    const Index hidden = c.memory_size;
    Outputs<S> out;
    out.resize(c, x.shape.columns());
    out.mask.setConstant(scans(c) ? S(0) : S(1));
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
        features << h, text(mission, scans(c) ? attention.mask : Vector<S>::Ones(mission.length));
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
