#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include <Eigen/Core>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/frames.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/nn/initialize.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Text-visual attention; equations (A1)-(A7) in docs/math.md, (1) and (2) of the paper.
///
///     A_i = softmax over the 49 cells of (q_i . K / sqrt(d_k))     one map a word
///     H_i = entropy of A_i,   w = softmax over the words of -H     a sharp map weighs more
///     M   = sum_i alpha_i w_i A_i                                  where the agent looks
///     s   = f + (1 - f) (M / (max M + eps))^p                      what scales O~ cell by cell
///
/// Cells with the same entry of a map share a number: a map is P numbers, each the probability of
/// *one* cell of that entry, and sums over cells are sums over entries weighted by how many cells
/// of the view have it. Which cells share is the vision's affair (vision.hpp). Exact either way.
///
/// shapes   N frames, L words of the longest mission, P entries, V words of the vocabulary
///          words [E, V] embeddings g~, counts [P, N] cells of each entry, alpha [L or more, N]
/// backward accumulates into grads and dwords (+=), overwrites dalpha (=)
template <std::floating_point S>
struct TextVisualAttention {
  struct Params {
    Matrix<S> query;  ///< [d_k, E]
    Matrix<S> key;    ///< [d_k, C]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"query", &Params::query}, nn::Field{"key", &Params::key}};
    }
  };
  /// What depends on the weights alone. With q = W_q g~ a score q . (W_k O~) / sqrt(d_k) is
  /// (W_k^T q / sqrt(d_k)) . O~, so keys need not be formed: a word has a probe that is compared
  /// with the encodings themselves.
  struct Tables {
    Matrix<S> queries;  ///< [d_k, V]; not as a gradient
    Matrix<S> probes;   ///< [C, V]
    static constexpr auto fields() { return std::tuple{nn::Field{"probes", &Tables::probes}}; }
  };
  struct Cache {
    Matrix<S> maps;      ///< [P, N*L] column n*L+i: A_i of one cell; 0 if not in view
    Matrix<S> log_maps;  ///< [P, N*L] its logarithm
    Matrix<S> entropy;   ///< [L, N] H, in units of entropy_base
    Matrix<S> weights;   ///< [L, N] w; 0 behind the mission's end
    Matrix<S> gaze;      ///< [P, N] M of one cell
    Matrix<S> scale;     ///< [P, N] s(M)
    Eigen::Array<Index, Eigen::Dynamic, 1> peak;  ///< [N] the entry where M is largest
    Matrix<S> dgaze, dweights;                    // [P, N], [L, N]: gradients on their way down
    Index words = 0;                              ///< L

    void resize(Index entries, Index frames, Index longest) {
      words = longest;
      for (auto* m : {&gaze, &scale, &dgaze}) m->resize(entries, frames);
      for (auto* m : {&maps, &log_maps}) m->resize(entries, frames * longest);
      for (auto* m : {&entropy, &weights, &dweights}) m->resize(longest, frames);
      peak.resize(frames);
    }
    Index map(Index frame, Index word) const { return frame * words + word; }
  };

  static void resize(const Config& c, Params& p) {
    p.query.resize(c.key_size, c.word_size);
    p.key.resize(c.key_size, c.channels);
  }
  static void resize(const Config& c, Tables& t) {
    t.queries.setZero(c.key_size, babyai::kVocabularySize);
    t.probes.setZero(c.channels, babyai::kVocabularySize);
  }
  static void initialize(core::Rng& rng, Params& p) {
    nn::fill_scaled(p.query, 1, rng);
    nn::fill_scaled(p.key, 1, rng);
  }
  /// Every word starts with a score of `object_prior` on cells whose channel 0 is 1 over all
  /// others: entry 0 of queries and keys carries the product with the first number of an embedding.
  static void set_object_prior(const Config& c, Params& p, Out<S> words) {
    words.row(0).setOnes();
    p.query.row(0).setZero();
    p.key.row(0).setZero();
    p.query(0, 0) = p.key(0, 0) =
        static_cast<S>(std::sqrt(c.object_prior * std::sqrt(static_cast<double>(c.key_size))));
  }

  static void refresh(const Params& p, In<S> words, Tables& t) {
    t.queries.noalias() = p.query * words;
    t.probes.noalias() = p.key.transpose() * t.queries;
    t.probes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
  }
  /// On entry dt.probes is the gradient of the probes; dt is used up.
  static void tables_backward(const Params& p, In<S> words, const Tables& t, Tables& dt,
                              Params& grads, Out<S> dwords) {
    dt.probes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
    dt.queries.noalias() = p.key * dt.probes;
    grads.key.noalias() += t.queries * dt.probes.transpose();
    grads.query.noalias() += dt.queries * words.transpose();
    dwords.noalias() += p.query.transpose() * dt.queries;
  }

  /// Maps, entropies and word weights, (A1)-(A4), from score_of(frame, word) [P].
  template <class ScoreOf>
  static void forward_words(const Config& c, In<S> counts_of, ScoreOf&& score_of,
                            const Frames<S>& x, const Missions& missions, Cache& k) {
    const S sharpness = sharpness_of(c);
    with_size(counts_of.rows(), [&](auto size) {
      using Numbers = Entries<size()>;
      for (Index n = 0; n < counts_of.cols(); ++n) {
        const Numbers counts = counts_of.col(n).array();
        const Numbers present = (counts > S(0)).template cast<S>();
        const auto& sentence = missions[x.mission(n)];
        auto weights = k.weights.col(n);
        auto entropy = k.entropy.col(n);
        weights.setZero();
        entropy.setZero();
        for (Index i = 0; i < sentence.length; ++i) {
          // The largest score in view, not of the table: else every exponential could underflow.
          const Numbers score = score_of(n, sentence.words[static_cast<std::size_t>(i)]).array() +
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

  /// M and s(M), (A5)-(A6), from the word weights times the mask alpha.
  static void forward_gaze(const Config& c, const Frames<S>& x, const Missions& missions,
                           In<S> alpha, Cache& k) {
    const S exponent = static_cast<S>(c.gaze_exponent), floor = static_cast<S>(c.gaze_floor);
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Index length = missions[x.mission(n)].length;
        Entries<size()> gaze = Entries<size()>::Zero();
        for (Index i = 0; i < length; ++i) {
          gaze += (alpha(i, n) * k.weights(i, n)) * column<size()>(k.maps, k.map(n, i));
        }
        const S most = gaze.maxCoeff(&k.peak(n)) + kEpsilon;
        k.gaze.col(n) = gaze;
        Entries<size()> scale;
        power(gaze * (S(1) / most), exponent, scale);
        k.scale.col(n) = floor + (S(1) - floor) * scale;
      }
    });
  }

  /// From dscale [P, N] (summed over the cells of each entry) to cache.dgaze, cache.dweights and
  /// dalpha, all overwritten.
  static void backward_gaze(const Config& c, const Frames<S>& x, const Missions& missions,
                            In<S> alpha, In<S> dscale, Cache& k, Out<S> dalpha) {
    const S exponent = static_cast<S>(c.gaze_exponent), floor = static_cast<S>(c.gaze_floor);
    dalpha.setZero();
    k.dweights.setZero();
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Entries<size()> gaze = k.gaze.col(n).array();
        const S inverse = S(1) / (gaze(k.peak(n)) + kEpsilon);
        Entries<size()> dgaze;
        power(gaze * inverse, exponent - S(1), dgaze);
        dgaze *= dscale.col(n).array() * ((S(1) - floor) * exponent * inverse);
        dgaze(k.peak(n)) -= (dgaze * gaze).sum() * inverse;
        k.dgaze.col(n) = dgaze;
        const Index length = missions[x.mission(n)].length;
        for (Index i = 0; i < length; ++i) {
          const S dmix = (dgaze * column<size()>(k.maps, k.map(n, i))).sum();
          dalpha(i, n) = k.weights(i, n) * dmix;
          k.dweights(i, n) = alpha(i, n) * dmix;
        }
      }
    });
  }

  /// From cache.dgaze and cache.dweights (the Task Attention Module may have added to it) to the
  /// gradients of the scores: calls take(frame, word, dscore [P]).
  template <class Take>
  static void backward_words(const Config& c, In<S> counts_of, const Frames<S>& x,
                             const Missions& missions, In<S> alpha, const Cache& k, Take&& take) {
    const S sharpness = sharpness_of(c);
    with_size(k.gaze.rows(), [&](auto size) {
      using Numbers = Entries<size()>;
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const auto& sentence = missions[x.mission(n)];
        const Numbers counts = counts_of.col(n).array();
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
          take(n, sentence.words[static_cast<std::size_t>(i)], dscore.matrix());
        }
      }
    });
  }

 private:
  static constexpr S kEpsilon = S(1e-6);
  /// One number an entry.
  template <int P>
  using Entries = Eigen::Array<S, P, 1>;

  /// Entropies are in units of entropy_base.
  static S sharpness_of(const Config& c) { return static_cast<S>(1 / std::log(c.entropy_base)); }

  /// Added to the scores of entries that are not in view.
  static constexpr S kOutOfView = S(1e9);

  /// Calls f with P as a constant: whole loops over entries then become a few packets in registers.
  template <class F>
  static void with_size(Index entries, F&& f) {
    switch (entries) {
      case 32:
        return f(std::integral_constant<int, 32>());
      case 48:
        return f(std::integral_constant<int, 48>());
      case 64:
        return f(std::integral_constant<int, 64>());
      default:
        throw std::logic_error("TextVisualAttention: no code for this number of entries");
    }
  }
  template <int P>
  static auto column(const Matrix<S>& m, Index index) {
    return Eigen::Map<const Entries<P>>(m.col(index).data());
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
