#pragma once
#include <cmath>

#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Indices of the codes in view, one column of 49 cells a frame.
using CellMatrix = Eigen::Matrix<std::uint8_t, grid::kViewCells, Eigen::Dynamic>;

/// Text-visual attention; equations (A1)-(A7) in docs/math.md, (1) and (2) of the paper.
///
///     A_i = softmax over the 49 cells of (q_i . K / sqrt(d_k))     one map a word
///     H_i = entropy of A_i,   w = softmax over the words of -H     a sharp map weighs more
///     M   = sum_i alpha_i w_i A_i                                  where the agent looks
///     s   = f + (1 - f) (M / (max M + eps))^p                      what scales O~ cell by cell
///
/// A score depends on the word and on the code in the cell alone. So scores are a table [P, V], a
/// map is P numbers (the probability of *one* cell with that code), and sums over cells are sums
/// over codes weighted by their counts in the view. Exact, and 49 cells become a handful of codes.
///
/// shapes   N frames, L words of the longest mission, P codes, V words of the vocabulary
template <std::floating_point S>
struct TextVisualAttention {
  /// One number a code, on the stack.
  using Codes = Eigen::Array<S, Eigen::Dynamic, 1, 0, kMaxCodes, 1>;
  static constexpr S kEpsilon = S(1e-6);

  struct Params {
    Matrix<S> query;  ///< [d_k, E]
    Matrix<S> key;    ///< [d_k, C]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"query", &Params::query}, nn::Field{"key", &Params::key}};
    }
  };
  static void resize(Params& p, Index key_size, Index word_size, Index channels) {
    p.query.resize(key_size, word_size);
    p.key.resize(key_size, channels);
  }

  /// What depends on the weights alone: rebuilt once a weight version.
  struct Tables {
    Matrix<S> queries, keys, scores;  // [d_k, V], [d_k, P], [P, V]
    void resize(Index key_size, Index words, Index codes) {
      queries.setZero(key_size, words);
      keys.setZero(key_size, codes);
      scores.setZero(codes, words);
    }
  };
  static void make_tables(const Params& p, In<S> words, In<S> visual, Tables& t) {
    t.queries.noalias() = p.query * words;
    t.keys.noalias() = p.key * visual;
    t.scores.noalias() = t.keys.transpose() * t.queries;
    t.scores *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
  }
  /// On entry dt.scores is the gradient of the scores; the rest of dt is overwritten. Accumulates
  /// into grads, dwords and dvisual.
  static void tables_backward(const Params& p, In<S> words, In<S> visual, const Tables& t,
                              Tables& dt, Params& grads, Out<S> dwords, Out<S> dvisual) {
    dt.scores *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
    dt.queries.noalias() = t.keys * dt.scores;
    dt.keys.noalias() = t.queries * dt.scores.transpose();
    grads.query.noalias() += dt.queries * words.transpose();
    grads.key.noalias() += dt.keys * visual.transpose();
    dwords.noalias() += p.query.transpose() * dt.queries;
    dvisual.noalias() += p.key.transpose() * dt.keys;
  }

  struct Cache {
    Matrix<S> counts;  ///< [P, N] cells of each code in view
    Matrix<S> maps;    ///< [P, N*L] column n*L+i: A_i of one cell with that code; 0 if not in view
    Matrix<S> log_maps;                           ///< [P, N*L] its logarithm
    Matrix<S> entropy;                            ///< [L, N] H, in units of entropy_base
    Matrix<S> weights;                            ///< [L, N] w; 0 behind the mission's end
    Matrix<S> gaze;                               ///< [P, N] M of one cell with that code
    Matrix<S> scale;                              ///< [P, N] s(M)
    Eigen::Array<Index, Eigen::Dynamic, 1> peak;  ///< [N] the code where M is largest
    Matrix<S> dgaze, dweights;                    // [P, N], [L, N]: gradients on their way down
    Index words = 0;                              ///< L

    void resize(Index codes, Index frames, Index longest) {
      words = longest;
      for (auto* m : {&counts, &gaze, &scale, &dgaze}) m->resize(codes, frames);
      for (auto* m : {&maps, &log_maps}) m->resize(codes, frames * longest);
      for (auto* m : {&entropy, &weights, &dweights}) m->resize(longest, frames);
      peak.resize(frames);
    }
    Index map(Index frame, Index word) const { return frame * words + word; }
  };

  /// Maps, entropies and word weights. `sharpness` is 1 / ln(entropy_base).
  static void forward_words(const Tables& t, const CellMatrix& cells, const Missions& missions,
                            const std::vector<int>& mission_of, S sharpness, Cache& k) {
    const Index codes = t.scores.rows();
    for (Index n = 0; n < cells.cols(); ++n) {
      auto counts = k.counts.col(n).array();
      counts.setZero();
      for (Index c = 0; c < grid::kViewCells; ++c) counts(cells(c, n)) += S(1);
      const Codes present = (counts > S(0)).template cast<S>();

      const auto& sentence = missions[mission_of[static_cast<std::size_t>(n)]];
      auto weights = k.weights.col(n);
      auto entropy = k.entropy.col(n);
      weights.setZero();
      entropy.setZero();
      for (Index i = 0; i < sentence.length; ++i) {
        const auto score = t.scores.col(sentence.words[static_cast<std::size_t>(i)]).array();
        // The largest score in view, not of the table: else every exponential could underflow.
        S top = -std::numeric_limits<S>::infinity();
        for (Index p = 0; p < codes; ++p) {
          if (counts(p) > S(0)) top = std::max(top, score(p));
        }
        auto map = k.maps.col(k.map(n, i)).array();
        auto log_map = k.log_maps.col(k.map(n, i)).array();
        log_map = (score - top).min(S(0));
        map = log_map.exp() * present;
        const S sum = (map * counts).sum();
        const S log_sum = std::log(sum);
        map *= S(1) / sum;
        log_map -= log_sum;
        entropy(i) = -(counts * map * log_map).sum() * sharpness;
      }
      auto w = weights.head(sentence.length).array();
      const auto h = entropy.head(sentence.length).array();
      w = (h.minCoeff() - h).exp();
      w *= S(1) / w.sum();
    }
  }

  /// M and s(M), from the word weights times the mask alpha [L or more, N].
  static void forward_gaze(const Missions& missions, const std::vector<int>& mission_of,
                           In<S> alpha, S exponent, S floor, Cache& k) {
    for (Index n = 0; n < k.gaze.cols(); ++n) {
      const Index length = missions[mission_of[static_cast<std::size_t>(n)]].length;
      auto gaze = k.gaze.col(n);
      gaze.setZero();
      for (Index i = 0; i < length; ++i) {
        gaze += (alpha(i, n) * k.weights(i, n)) * k.maps.col(k.map(n, i));
      }
      const S most = gaze.maxCoeff(&k.peak(n)) + kEpsilon;
      auto scale = k.scale.col(n).array();
      power(gaze.array() * (S(1) / most), exponent, scale);
      scale = floor + (S(1) - floor) * scale;
    }
  }

  /// From dscale [P, N] (summed over the cells of each code) to cache.dgaze, cache.dweights and
  /// dalpha [L or more, N], all overwritten.
  static void backward_gaze(const Missions& missions, const std::vector<int>& mission_of,
                            In<S> alpha, S exponent, S floor, In<S> dscale, Cache& k,
                            Out<S> dalpha) {
    dalpha.setZero();
    k.dweights.setZero();
    for (Index n = 0; n < k.gaze.cols(); ++n) {
      const auto gaze = k.gaze.col(n).array();
      const S inverse = S(1) / (gaze(k.peak(n)) + kEpsilon);
      auto dgaze = k.dgaze.col(n).array();
      Codes slope(gaze.size());
      power(gaze * inverse, exponent - S(1), slope);
      dgaze = dscale.col(n).array() * slope * ((S(1) - floor) * exponent * inverse);
      dgaze(k.peak(n)) -= (dgaze * gaze).sum() * inverse;
      const Index length = missions[mission_of[static_cast<std::size_t>(n)]].length;
      for (Index i = 0; i < length; ++i) {
        const S dmix = dgaze.matrix().dot(k.maps.col(k.map(n, i)));
        dalpha(i, n) = k.weights(i, n) * dmix;
        k.dweights(i, n) = alpha(i, n) * dmix;
      }
    }
  }

  /// From cache.dgaze and cache.dweights (the Task Attention Module may have added to it) to the
  /// table of scores (+=).
  static void backward_words(const Missions& missions, const std::vector<int>& mission_of,
                             In<S> alpha, S sharpness, Cache& k, Out<S> dscores) {
    for (Index n = 0; n < k.gaze.cols(); ++n) {
      const auto& sentence = missions[mission_of[static_cast<std::size_t>(n)]];
      const auto counts = k.counts.col(n).array();
      const auto dgaze = k.dgaze.col(n).array();
      const auto w = k.weights.col(n).head(sentence.length);
      const auto dw = k.dweights.col(n).head(sentence.length);
      const S mean = w.dot(dw);
      for (Index i = 0; i < sentence.length; ++i) {
        const auto map = k.maps.col(k.map(n, i)).array();
        const auto log_map = k.log_maps.col(k.map(n, i)).array();
        const S mix = alpha(i, n) * w(i);
        const S pull = mix * (map * dgaze).sum();  // the softmax's shared term
        // Entropy in natural units: H = -sum counts A log A; dH/dscore = -counts A (log A + H).
        const S dentropy = -w(i) * (dw(i) - mean) * sharpness;
        const S entropy = k.entropy(i, n) / sharpness;
        dscores.col(sentence.words[static_cast<std::size_t>(i)]).array() +=
            map * (mix * dgaze - counts * (pull + dentropy * (log_map + entropy)));
      }
    }
  }

 private:
  template <class X, class Y>
  static void power(const X& base, S exponent, Y&& result) {
    if (exponent == S(0)) {
      result.setOnes();
    } else if (exponent == S(1)) {
      result.array() = base;
    } else if (exponent == S(2)) {
      result.array() = base.square();
    } else {
      result.array() = base.pow(exponent);
    }
  }
};

}  // namespace wordgaze::model
