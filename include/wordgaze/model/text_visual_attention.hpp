#pragma once
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Text-visual attention; equations (A1)-(A7) in docs/math.md, (1) and (2) of the paper.
///
///     A_i = softmax over the 49 cells of (q_i . K / sqrt(d_k))     one map a word
///     H_i = entropy of A_i,   w = softmax over the words of -H     a sharp map weighs more
///     M   = sum_i alpha_i w_i A_i                                  where the agent looks
///     s   = f + (1 - f) (M / (max M + eps))^p                      what scales O~ cell by cell
///
/// Cells of one kind share their numbers: a map is P numbers, each the probability of *one* cell of
/// that kind, and sums over cells are sums over kinds weighted by their counts in the view. Where
/// the encoding looks at one cell at a time, a kind is a code: scores are a table [P, V], and 49
/// cells become a handful of codes. Where it sees neighbors, each slot of the view (view_map.hpp)
/// is a kind of its own that occurs once. Exact either way.
///
/// shapes   N frames, L words of the longest mission, P kinds, V words of the vocabulary
template <std::floating_point S>
struct TextVisualAttention {
  /// One number a kind.
  template <int P>
  using Kinds = Eigen::Array<S, P, 1>;
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

  /// What depends on the weights alone: rebuilt once a weight version. With q = W_q g~ a score
  /// q . (W_k O~) / sqrt(d_k) is (W_k^T q / sqrt(d_k)) . O~, so keys need not be formed: a word has
  /// a probe that is compared with the encodings themselves.
  struct Tables {
    Matrix<S> queries;  // [d_k, V]
    Matrix<S> probes;   // [C, V]
    Matrix<S> scores;   // [P, V]; only where O~ is a table over the alphabet
    void resize(Index key_size, Index channels, Index words, Index codes) {
      queries.setZero(key_size, words);
      probes.setZero(channels, words);
      scores.setZero(codes, words);
    }
  };
  static void make_probes(const Params& p, In<S> words, Tables& t) {
    t.queries.noalias() = p.query * words;
    t.probes.noalias() = p.key.transpose() * t.queries;
    t.probes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
  }
  /// On entry dt.probes is the gradient of the probes; it and dt.queries are used up. Accumulates
  /// into grads and dwords.
  static void probes_backward(const Params& p, In<S> words, const Tables& t, Tables& dt,
                              Params& grads, Out<S> dwords) {
    dt.probes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
    dt.queries.noalias() = p.key * dt.probes;
    grads.key.noalias() += t.queries * dt.probes.transpose();
    grads.query.noalias() += dt.queries * words.transpose();
    dwords.noalias() += p.query.transpose() * dt.queries;
  }
  /// Scores of an encoding [C, P or fewer] that is a table over the alphabet.
  static void make_scores(In<S> visual, Tables& t) {
    t.scores.topRows(visual.cols()).noalias() = visual.transpose() * t.probes;
  }
  /// From dt.scores to dt.probes and dvisual, both accumulated.
  static void scores_backward(In<S> visual, const Tables& t, Tables& dt, Out<S> dvisual) {
    const auto dscores = dt.scores.topRows(visual.cols());
    dt.probes.noalias() += visual * dscores;
    dvisual.noalias() += t.probes * dscores.transpose();
  }

  struct Cache {
    Matrix<S> counts;    ///< [P, N] cells of each kind in view
    Matrix<S> maps;      ///< [P, N*L] column n*L+i: A_i of one cell of that kind; 0 if not in view
    Matrix<S> log_maps;  ///< [P, N*L] its logarithm
    Matrix<S> entropy;   ///< [L, N] H, in units of entropy_base
    Matrix<S> weights;   ///< [L, N] w; 0 behind the mission's end
    Matrix<S> gaze;      ///< [P, N] M of one cell of that kind
    Matrix<S> scale;     ///< [P, N] s(M)
    Eigen::Array<Index, Eigen::Dynamic, 1> peak;  ///< [N] the kind where M is largest
    Matrix<S> dgaze, dweights;                    // [P, N], [L, N]: gradients on their way down
    Index words = 0;                              ///< L

    void resize(Index kinds, Index frames, Index longest) {
      words = longest;
      for (auto* m : {&counts, &gaze, &scale, &dgaze}) m->resize(kinds, frames);
      for (auto* m : {&maps, &log_maps}) m->resize(kinds, frames * longest);
      for (auto* m : {&entropy, &weights, &dweights}) m->resize(longest, frames);
      peak.resize(frames);
    }
    Index map(Index frame, Index word) const { return frame * words + word; }
  };

  /// Where kinds are codes: how many cells of each are in view.
  static void count_codes(const CellMatrix& cells, Cache& k) {
    k.counts.setZero();
    for (Index n = 0; n < cells.cols(); ++n) {
      for (Index c = 0; c < grid::kViewCells; ++c) k.counts(cells(c, n), n) += S(1);
    }
  }

  /// Maps, entropies and word weights, from cache.counts and score_of(frame, place in the mission,
  /// word) [P]. `sharpness` is 1 / ln(entropy_base).
  template <class ScoreOf>
  static void forward_words(ScoreOf&& score_of, const Missions& missions,
                            const std::vector<int>& mission_of, S sharpness, Cache& k) {
    with_size(k.counts.rows(), [&](auto size) {
      using Numbers = Kinds<size()>;
      for (Index n = 0; n < k.counts.cols(); ++n) {
        const Numbers counts = k.counts.col(n).array();
        const Numbers present = (counts > S(0)).template cast<S>();
        const auto& sentence = missions[mission_of[static_cast<std::size_t>(n)]];
        auto weights = k.weights.col(n);
        auto entropy = k.entropy.col(n);
        weights.setZero();
        entropy.setZero();
        for (Index i = 0; i < sentence.length; ++i) {
          // The largest score in view, not of the table: else every exponential could underflow.
          const Numbers score =
              score_of(n, i, sentence.words[static_cast<std::size_t>(i)]).array() +
              (present - S(1)) * kOutOfView;
          Numbers log_map = score - score.maxCoeff();
          Numbers map = log_map.exp() * present;
          const S sum = (map * counts).sum();
          map *= S(1) / sum;
          log_map -= std::log(sum);
          entropy(i) = -(counts * map * log_map).sum() * sharpness;
          k.maps.col(k.map(n, i)) = map;
          k.log_maps.col(k.map(n, i)) = log_map;
        }
        auto w = weights.head(sentence.length).array();
        const auto h = entropy.head(sentence.length).array();
        w = (h.minCoeff() - h).exp();
        w *= S(1) / w.sum();
      }
    });
  }

  /// M and s(M), from the word weights times the mask alpha [L or more, N].
  static void forward_gaze(const Missions& missions, const std::vector<int>& mission_of,
                           In<S> alpha, S exponent, S floor, Cache& k) {
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Index length = missions[mission_of[static_cast<std::size_t>(n)]].length;
        Kinds<size()> gaze = Kinds<size()>::Zero();
        for (Index i = 0; i < length; ++i) {
          gaze += (alpha(i, n) * k.weights(i, n)) * column<size()>(k.maps, k.map(n, i));
        }
        const S most = gaze.maxCoeff(&k.peak(n)) + kEpsilon;
        k.gaze.col(n) = gaze;
        Kinds<size()> scale;
        power(gaze * (S(1) / most), exponent, scale);
        k.scale.col(n) = floor + (S(1) - floor) * scale;
      }
    });
  }

  /// From dscale [P, N] (summed over the cells of each kind) to cache.dgaze, cache.dweights and
  /// dalpha [L or more, N], all overwritten.
  static void backward_gaze(const Missions& missions, const std::vector<int>& mission_of,
                            In<S> alpha, S exponent, S floor, In<S> dscale, Cache& k,
                            Out<S> dalpha) {
    dalpha.setZero();
    k.dweights.setZero();
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Kinds<size()> gaze = k.gaze.col(n).array();
        const S inverse = S(1) / (gaze(k.peak(n)) + kEpsilon);
        Kinds<size()> dgaze;
        power(gaze * inverse, exponent - S(1), dgaze);
        dgaze *= dscale.col(n).array() * ((S(1) - floor) * exponent * inverse);
        dgaze(k.peak(n)) -= (dgaze * gaze).sum() * inverse;
        k.dgaze.col(n) = dgaze;
        const Index length = missions[mission_of[static_cast<std::size_t>(n)]].length;
        for (Index i = 0; i < length; ++i) {
          const S dmix = (dgaze * column<size()>(k.maps, k.map(n, i))).sum();
          dalpha(i, n) = k.weights(i, n) * dmix;
          k.dweights(i, n) = alpha(i, n) * dmix;
        }
      }
    });
  }

  /// From cache.dgaze and cache.dweights (the Task Attention Module may have added to it) to the
  /// gradients of the scores: calls take(frame, place in the mission, word, dscore [P]).
  template <class Take>
  static void backward_words(const Missions& missions, const std::vector<int>& mission_of,
                             In<S> alpha, S sharpness, const Cache& k, Take&& take) {
    with_size(k.gaze.rows(), [&](auto size) {
      using Numbers = Kinds<size()>;
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const auto& sentence = missions[mission_of[static_cast<std::size_t>(n)]];
        const Numbers counts = k.counts.col(n).array();
        const Numbers dgaze = k.dgaze.col(n).array();
        const auto w = k.weights.col(n).head(sentence.length);
        const auto dw = k.dweights.col(n).head(sentence.length);
        const S mean = w.dot(dw);
        for (Index i = 0; i < sentence.length; ++i) {
          const Numbers map = column<size()>(k.maps, k.map(n, i));
          const Numbers log_map = column<size()>(k.log_maps, k.map(n, i));
          const S mix = alpha(i, n) * w(i);
          const S pull = mix * (map * dgaze).sum();  // the softmax's shared term
          // Entropy in natural units: H = -sum counts A log A; dH/dscore = -counts A (log A + H).
          const S dentropy = -w(i) * (dw(i) - mean) * sharpness;
          const S entropy = k.entropy(i, n) / sharpness;
          const Numbers dscore =
              map * (mix * dgaze - counts * (pull + dentropy * (log_map + entropy)));
          take(n, i, sentence.words[static_cast<std::size_t>(i)], dscore.matrix());
        }
      }
    });
  }

 private:
  /// Added to the scores of kinds that are not in view.
  static constexpr S kOutOfView = S(1e9);

  /// Calls f with P as a constant: whole loops over kinds then become a few packets in registers.
  template <class F>
  static void with_size(Index kinds, F&& f) {
    switch (kinds) {
      case 32:
        return f(std::integral_constant<int, 32>());
      case 48:
        return f(std::integral_constant<int, 48>());
      case 64:
        return f(std::integral_constant<int, 64>());
      default:
        throw std::logic_error("TextVisualAttention: no code for this number of kinds");
    }
  }
  template <int P>
  static auto column(const Matrix<S>& m, Index index) {
    return Eigen::Map<const Kinds<P>>(m.col(index).data());
  }

  template <class X, class Y>
  static void power(const X& base, S exponent, Y&& result) {
    if (exponent == S(0)) {
      result.fill(S(1));
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
