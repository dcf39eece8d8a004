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
#include "wordgaze/model/word_tables.hpp"
#include "wordgaze/nn/initialize.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Text-visual attention; equations (A1)-(A7) in docs/math.md, (1) and (2) of the paper.
///
///     A_i = softmax of beta (q_i . K / sqrt(d_k))                  one map a word
///     H_i = entropy of A_i,   w = softmax over the words of -H     a sharp map weighs more
///
/// over the 49 cells and, in the product, nowhere. A mission without words has no maps: M is 0 or,
/// in the product, what S_0 alone says. M says where the agent looks, s(M) scales O~
/// cell by cell; 0 is nowhere, S_0 the silent word (word_tables.hpp):
///
///     product    M = softmax(Z),  Z = S_0 + sum_i a_i ln A_i,  a_i = alpha_i w_i / sum alpha w
///                s = f + (1 - f) M / (M + M_0)
///     sum        M = sum_i alpha_i w_i A_i
///                s = f + (1 - f) (M / (max M + eps))^p,  beta = 1
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
    Matrix<S> query;   ///< [d_k, E]
    Matrix<S> key;     ///< [d_k, C]
    Vector<S> silent;  ///< [C] probe of the silent word; empty for the sum
    Matrix<S> words;   ///< [1, V] choice of type (positive) or color; empty for the sum
    Vector<S> focus;   ///< [1] how far the gaze has focused, set by training; empty for the sum
    static constexpr auto fields() {
      return std::tuple{nn::Field{"query", &Params::query}, nn::Field{"key", &Params::key},
                        nn::Field{"silent", &Params::silent}, nn::Field{"words", &Params::words},
                        nn::Field{"focus", &Params::focus}};
    }
  };
  using Tables = WordTables<S>;
  struct Cache {
    Matrix<S> maps;      ///< [P, N*L] column n*L+i: A_i of one cell; 0 if not in view
    Matrix<S> log_maps;  ///< [P, N*L] its logarithm
    Matrix<S> entropy;   ///< [L, N] H, in units of entropy_base
    Matrix<S> weights;   ///< [L, N] w; 0 behind the mission's end
    Matrix<S> gaze;      ///< [P, N] M of one cell; of nowhere
    Matrix<S> scale;     ///< [P, N] s(M)
    Vector<S> total;     ///< [N] sum of alpha w; product only
    Eigen::Array<Index, Eigen::Dynamic, 1> peak;  ///< [N] the entry where M is largest; sum only
    Matrix<S> dgaze, dweights;                    // [P, N], [L, N]: gradients on their way down
    Index words = 0;                              ///< L
    Index nowhere = -1;                           ///< its entry

    void resize(Index entries, Index nowhere_entry, Index frames, Index longest) {
      words = longest;
      nowhere = nowhere_entry;
      for (auto* m : {&gaze, &scale, &dgaze}) m->resize(entries, frames);
      for (auto* m : {&maps, &log_maps}) m->resize(entries, frames * longest);
      for (auto* m : {&entropy, &weights, &dweights}) m->resize(longest, frames);
      total.resize(frames);
      peak.resize(frames);
    }
    Index map(Index frame, Index word) const { return frame * words + word; }
  };

  static void resize(const Config& c, Params& p) {
    p.query.resize(c.key_size, c.word_size);
    p.key.resize(c.key_size, c.channels);
    if (c.gaze == Gaze::product) {
      p.silent.resize(c.channels);
      p.words.setZero(1, babyai::kVocabularySize);
      p.focus.resize(1);
    }
  }
  static void resize(const Config& c, Tables& t) {
    t.queries.setZero(c.key_size, babyai::kVocabularySize);
    t.probes.setZero(c.channels, babyai::kVocabularySize + 1);
    if (c.gaze == Gaze::product) t.choice.setZero(1, babyai::kVocabularySize);
  }
  static void initialize(core::Rng& rng, Params& p) {
    nn::fill_scaled(p.query, 1, rng);
    nn::fill_scaled(p.key, 1, rng);
  }
  /// Cells whose channel 0 is 1 start with a score of `object_prior` over all others: that of the
  /// silent word, or in the sum that of every word. There entry 0 of queries and keys carries the
  /// product with the first number of an embedding.
  static void set_object_prior(const Config& c, Params& p, Out<S> words) {
    if (c.gaze == Gaze::product) {
      p.silent(0) = static_cast<S>(c.object_prior);
      return;
    }
    words.row(0).setOnes();
    p.query.row(0).setZero();
    p.key.row(0).setZero();
    p.query(0, 0) = p.key(0, 0) =
        static_cast<S>(std::sqrt(c.object_prior * std::sqrt(static_cast<double>(c.key_size))));
  }
  /// Focuses, but never blurs again: a second phase goes on as focused as the first has ended.
  /// Returns whether anything has changed.
  static bool set_focus(Params& p, double focus) {
    if (p.focus.size() == 0 || !(focus > static_cast<double>(p.focus(0)))) return false;
    p.focus(0) = static_cast<S>(focus);
    return true;
  }

  static void refresh(const Config& c, const Params& p, In<S> words, Tables& t) {
    t.queries.noalias() = p.query * words;
    auto probes = t.probes.leftCols(kSilentWord);
    probes.noalias() = p.key.transpose() * t.queries;
    probes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
    if (p.silent.size() > 0) t.probes.col(kSilentWord) = p.silent;
    t.choice = p.words;
    t.focus = p.focus.size() > 0 ? p.focus(0) : S(1);
    t.sharpness =
        c.gaze == Gaze::sum
            ? S(1)
            : static_cast<S>(focused(c.sharpness_start, c.sharpness, static_cast<double>(t.focus)));
  }
  /// On entry dt.probes is the gradient of the probes; dt is used up.
  static void tables_backward(const Params& p, In<S> words, const Tables& t, Tables& dt,
                              Params& grads, Out<S> dwords) {
    if (p.silent.size() > 0) {
      grads.silent += dt.probes.col(kSilentWord);
      grads.words += dt.choice;
    }
    auto dprobes = dt.probes.leftCols(kSilentWord);
    dprobes *= S(1) / std::sqrt(static_cast<S>(p.key.rows()));
    dt.queries.noalias() = p.key * dprobes;
    grads.key.noalias() += t.queries * dprobes.transpose();
    grads.query.noalias() += dt.queries * words.transpose();
    dwords.noalias() += p.query.transpose() * dt.queries;
  }

  /// Maps, entropies and word weights, (A1)-(A4), from score_of(frame, word) [P].
  template <class ScoreOf>
  static void forward_words(const Config& c, const Tables& t, In<S> counts_of, ScoreOf&& score_of,
                            const Frames<S>& x, const Missions& missions, Cache& k) {
    const S unit = unit_of(c), beta = t.sharpness;
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
          const Numbers score =
              beta * score_of(n, sentence.words[static_cast<std::size_t>(i)]).array() +
              (present - S(1)) * kOutOfView;
          Numbers log_map = score - score.maxCoeff();
          Numbers map = log_map.exp() * present;
          const S sum = (map * counts).sum();
          map *= S(1) / sum;
          log_map -= std::log(sum);
          entropy(i) = -(counts * map * log_map).sum() * unit;
          k.maps.col(k.map(n, i)) = map;
          k.log_maps.col(k.map(n, i)) = log_map;
        }
        if (sentence.length == 0) continue;
        auto w = weights.head(sentence.length).array();
        const auto h = entropy.head(sentence.length).array();
        w = (h.minCoeff() - h).exp();
        w *= S(1) / w.sum();
      }
    });
  }

  /// M and s(M), (A5)-(A6), from the word weights times the mask alpha.
  template <class ScoreOf>
  static void forward_gaze(const Config& c, In<S> counts_of, ScoreOf&& score_of, const Frames<S>& x,
                           const Missions& missions, In<S> alpha, Cache& k) {
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Index length = missions[x.mission(n)].length;
        if (c.gaze == Gaze::sum) {
          add_maps<size()>(c, n, length, alpha, k);
        } else {
          const Entries<size()> silent = score_of(n, kSilentWord).array();
          multiply_maps<size()>(c, n, length, counts_of.col(n).array(), silent, alpha, k);
        }
      }
    });
  }

  /// From dscale [P, N] (summed over the cells of each entry) to cache.dgaze, cache.dweights and
  /// dalpha, all overwritten. Of the product, cache.dgaze is the gradient of Z.
  static void backward_gaze(const Config& c, const Frames<S>& x, const Missions& missions,
                            In<S> alpha, In<S> dscale, Cache& k, Out<S> dalpha) {
    dalpha.setZero();
    k.dweights.setZero();
    with_size(k.gaze.rows(), [&](auto size) {
      for (Index n = 0; n < k.gaze.cols(); ++n) {
        const Index length = missions[x.mission(n)].length;
        if (c.gaze == Gaze::sum) {
          add_maps_backward<size()>(c, n, length, alpha, dscale.col(n).array(), k, dalpha);
        } else {
          multiply_maps_backward<size()>(c, n, length, alpha, dscale.col(n).array(), k, dalpha);
        }
      }
    });
  }

  /// From cache.dgaze and cache.dweights (the Task Attention Module may have added to it) to the
  /// gradients of the scores: calls take(frame, word, dscore [P]).
  template <class Take>
  static void backward_words(const Config& c, const Tables& t, In<S> counts_of, const Frames<S>& x,
                             const Missions& missions, In<S> alpha, const Cache& k, Take&& take) {
    const S unit = unit_of(c), beta = t.sharpness;
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
          // Entropy in natural units: H = -sum counts A log A; dH/dscore = -counts A (log A + H).
          const S dentropy = -w(i) * (dw(i) - mean) * unit;
          const S entropy = k.entropy(i, n) / unit;
          const S mix = alpha(i, n) * w(i);
          Numbers dscore = -(map * counts) * (dentropy * (log_map + entropy));
          if (c.gaze == Gaze::sum) {
            dscore += map * (mix * dgaze - counts * (mix * (map * dgaze).sum()));
          } else {
            dscore +=
                (mix / k.total(n)) * dgaze;  // the softmax's shared term is 0: dgaze sums to 0
          }
          take(n, sentence.words[static_cast<std::size_t>(i)], (beta * dscore).matrix());
        }
        if (c.gaze == Gaze::product) take(n, kSilentWord, dgaze.matrix());
      }
    });
  }

 private:
  static constexpr S kEpsilon = S(1e-6);
  /// One number an entry.
  template <int P>
  using Entries = Eigen::Array<S, P, 1>;

  /// Entropies are in units of entropy_base.
  static S unit_of(const Config& c) { return static_cast<S>(1 / std::log(c.entropy_base)); }

  /// Added to the scores of entries that are not in view.
  static constexpr S kOutOfView = S(1e9);
  /// exp of it is far from overflow, and 1 + exp of it drowns the 1.
  static constexpr S kLargestExponent = S(60);

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

  template <int P, class Row>
  static void multiply_maps(const Config& c, Index n, Index length, const Row& counts,
                            const Entries<P>& silent, In<S> alpha, Cache& k) {
    Entries<P> z = Entries<P>::Zero();
    S total = kEpsilon;
    for (Index i = 0; i < length; ++i) {
      const S a = alpha(i, n) * k.weights(i, n);
      z += a * column<P>(k.log_maps, k.map(n, i));
      total += a;
    }
    const Entries<P> present = (counts > S(0)).template cast<S>();
    z = (z * (S(1) / total) + silent) * present + (present - S(1)) * kOutOfView;
    const Entries<P> e = (z - z.maxCoeff()).exp();
    k.gaze.col(n) = e * (S(1) / (e * counts).sum());
    k.total(n) = total;
    // M / (M + M_0) without dividing what may have underflowed.
    const auto floor = static_cast<S>(c.gaze_floor);
    const auto odds = (z(k.nowhere) - z).min(kLargestExponent).exp();
    k.scale.col(n) = floor + (S(1) - floor) / (S(1) + odds);
  }
  template <int P, class Row>
  static void multiply_maps_backward(const Config& c, Index n, Index length, In<S> alpha,
                                     const Row& dscale, Cache& k, Out<S> dalpha) {
    const auto height = static_cast<S>(1 - c.gaze_floor);
    if (height == S(0)) {
      k.dgaze.col(n).setZero();
      return;
    }
    const Entries<P> lit =
        (k.scale.col(n).array() - static_cast<S>(c.gaze_floor)) * (S(1) / height);
    Entries<P> dz = height * lit * (S(1) - lit) * dscale;
    dz(k.nowhere) = S(0);
    dz(k.nowhere) = -dz.sum();
    k.dgaze.col(n) = dz;
    // a_i are normalized: what all of them ask in common cancels.
    S common = 0;
    for (Index i = 0; i < length; ++i) {
      dalpha(i, n) = (dz * column<P>(k.log_maps, k.map(n, i))).sum() / k.total(n);
      common += alpha(i, n) * k.weights(i, n) * dalpha(i, n) / k.total(n);
    }
    for (Index i = 0; i < length; ++i) {
      const S dmix = dalpha(i, n) - common;
      dalpha(i, n) = k.weights(i, n) * dmix;
      k.dweights(i, n) = alpha(i, n) * dmix;
    }
  }

  template <int P>
  static void add_maps(const Config& c, Index n, Index length, In<S> alpha, Cache& k) {
    const auto floor = static_cast<S>(c.gaze_floor);
    Entries<P> gaze = Entries<P>::Zero();
    for (Index i = 0; i < length; ++i) {
      gaze += (alpha(i, n) * k.weights(i, n)) * column<P>(k.maps, k.map(n, i));
    }
    const S most = gaze.maxCoeff(&k.peak(n)) + kEpsilon;
    k.gaze.col(n) = gaze;
    Entries<P> scale;
    power(gaze * (S(1) / most), static_cast<S>(c.gaze_exponent), scale);
    k.scale.col(n) = floor + (S(1) - floor) * scale;
  }
  template <int P, class Row>
  static void add_maps_backward(const Config& c, Index n, Index length, In<S> alpha,
                                const Row& dscale, Cache& k, Out<S> dalpha) {
    const auto exponent = static_cast<S>(c.gaze_exponent), floor = static_cast<S>(c.gaze_floor);
    const Entries<P> gaze = k.gaze.col(n).array();
    const S inverse = S(1) / (gaze(k.peak(n)) + kEpsilon);
    Entries<P> dgaze;
    power(gaze * inverse, exponent - S(1), dgaze);
    dgaze *= dscale * ((S(1) - floor) * exponent * inverse);
    dgaze(k.peak(n)) -= (dgaze * gaze).sum() * inverse;
    k.dgaze.col(n) = dgaze;
    for (Index i = 0; i < length; ++i) {
      const S dmix = (dgaze * column<P>(k.maps, k.map(n, i))).sum();
      dalpha(i, n) = k.weights(i, n) * dmix;
      k.dweights(i, n) = alpha(i, n) * dmix;
    }
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
