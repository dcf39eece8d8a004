#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/cell_encoder.hpp"
#include "wordgaze/model/lexicon.hpp"
#include "wordgaze/model/word_tables.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// Vision (vision.hpp) by an encoder that looks at one cell at a time. A view shows few codes, so
/// whatever depends on one cell is a table over them, made once a version of the weights:
///
///     encodings  O~ of each code
///     scores     of each word on each code and, behind them, on nowhere
///     input      (the columns of W_x of a cell) times (O~ of a code), for each cell and code
///
/// With the last the filtered view F = O~ * s(M) is never formed: W_x F is a sum over the 49 cells
/// of s[code] times a column of the table; (F1)-(F2) in docs/math.md. Exact for any such encoder.
///
/// The entries of a map are the codes, filled up to whole packets with codes that are never in
/// view: columns of odd length cost twice the time.
template <std::floating_point S, template <class> class EncoderOf>
struct TableVision {
  using Encoder = EncoderOf<S>;
  using Params = typename Encoder::Params;

  struct Tables {
    Matrix<S> encodings;                  ///< [C, codes]
    Matrix<S> scores;                     ///< [P, V + 1]; empty without attention
    typename Lexicon<S>::Tables lexicon;  // empty but for the product gaze
    Matrix<S> input;                      ///< [4 H, 49 codes]: column cell * codes + code
    static constexpr auto fields() {
      return std::tuple{nn::Field{"encodings", &Tables::encodings},
                        nn::Field{"scores", &Tables::scores}, nn::Field{"input", &Tables::input}};
    }
  };
  struct Cache {
    Matrix<S> counts;  ///< [P, N] cells of each code in view; of nowhere 1, or 0 for the sum gaze
  };

  static void resize(const Design& d, Params& p) { Encoder::resize(d, p); }
  static void resize(const Design& d, Tables& t) {
    const Config& c = d.config;
    t.encodings.setZero(c.channels, d.alphabet.size());
    t.scores.setZero(c.attention ? entries(d) : 0, babyai::kVocabularySize + 1);
    if (c.attention && c.gaze == Gaze::product) Lexicon<S>::resize(d, t.lexicon);
    t.input.setZero(4 * c.memory_size, grid::kViewCells * d.alphabet.size());
  }
  static void resize(const Design& d, Index frames, Cache& k) {
    k.counts.resize(entries(d), frames);
  }
  static void initialize(const Design& d, core::Rng& rng, Params& p) {
    Encoder::initialize(d, rng, p);
  }
  static void set_object_channel(const Design&, Params& p) { Encoder::set_object_channel(p); }

  static Index entries(const Design& d) {
    constexpr Index kPacket = 16;
    return (nowhere(d) + 1 + kPacket - 1) / kPacket * kPacket;
  }
  static Index nowhere(const Design& d) { return d.alphabet.size(); }
  static Index entry(const Design&, const CellMatrix& cells, Index cell, Index n) {
    return cells(cell, n);
  }
  static auto encoding(const Design&, const Tables& t, const Cache&, const CellMatrix& cells,
                       Index cell, Index n) {
    return t.encodings.col(cells(cell, n));
  }

  static void refresh(const Design& d, const Params& p, const WordTables<S>& words,
                      In<S> input_weight, Tables& t, Team& team) {
    Encoder::forward(d, p, t.encodings);
    if (d.config.attention) {
      auto scores = t.scores.topRows(d.alphabet.size());
      scores.noalias() = t.encodings.transpose() * words.probes;
      if (d.config.gaze == Gaze::product) {
        Lexicon<S>::forward(d.config, words, t.lexicon, t.scores.topRows(nowhere(d) + 1));
      }
    }
    const Index channels = t.encodings.rows(), codes = t.encodings.cols();
    team.run([&](int w) {
      const auto [from, to] = team.share(grid::kViewCells, w);
      for (Index c = from; c < to; ++c) {
        t.input.middleCols(c * codes, codes).noalias() =
            input_weight.middleCols(c * channels, channels) * t.encodings;
      }
    });
  }

  static void forward(const Design&, const Params&, const Tables&, const CellMatrix&, Cache&) {}

  template <class F>
  static void with_scores(const Design& d, const Tables& t, const WordTables<S>&,
                          const CellMatrix& cells, Cache& k, F&& f) {
    k.counts.setZero();
    if (d.config.gaze == Gaze::product) k.counts.row(nowhere(d)).setOnes();
    for (Index n = 0; n < cells.cols(); ++n) {
      for (Index c = 0; c < grid::kViewCells; ++c) k.counts(cells(c, n), n) += S(1);
    }
    f(k.counts, [&](Index, Index word) { return t.scores.col(word); });
  }

  // Cells outside, frames inside: the few columns of a cell that frames ask for stay in the cache,
  // the whole table (about a megabyte) does not.

  /// Seven cells are added in one pass over the column.
  static void read(const Design&, const Tables& t, In<S> /*input_weight*/, const CellMatrix& cells,
                   In<S> scale, Cache&, Out<S> product) {
    const Index codes = t.encodings.cols();
    for (Index c = 0; c < grid::kViewCells; c += grid::kViewSize) {
      for (Index n = 0; n < cells.cols(); ++n) {
        auto y = product.col(n);
        const auto term = [&](Index k) {
          const Index code = cells(c + k, n);
          return scale(code, n) * t.input.col((c + k) * codes + code);
        };
        const auto row =
            (((term(0) + term(1)) + (term(2) + term(3))) + ((term(4) + term(5)) + term(6)));
        if (c == 0) {
          y = row;
        } else {
          y += row;
        }
      }
    }
  }
  static void read_backward(const Design&, const Tables& t, In<S> /*input_weight*/,
                            const CellMatrix& cells, In<S> scale, In<S> dproduct, Cache&,
                            Matrix<S>& /*dinput_weight*/, Tables& dt, Out<S> dscale) {
    const Index codes = t.encodings.cols();
    dscale.setZero();
    for (Index c = 0; c < grid::kViewCells; ++c) {
      for (Index n = 0; n < cells.cols(); ++n) {
        const auto dy = dproduct.col(n);
        const Index code = cells(c, n), column = c * codes + code;
        dscale(code, n) += t.input.col(column).dot(dy);
        dt.input.col(column) += scale(code, n) * dy;
      }
    }
  }

  template <class F>
  static void with_score_gradients(const Design&, const Tables&, const WordTables<S>&, Cache& k,
                                   Tables& dt, WordTables<S>&, F&& f) {
    f(k.counts, [&](Index, Index word, const auto& dscore) { dt.scores.col(word) += dscore; });
  }

  static void backward(const Design&, const Params&, const Tables&, const CellMatrix&, Cache&,
                       Params&, Tables&) {}

  static bool input_weight_from_tables(const Design&) { return true; }

  /// The gradient of the large table, cells shared out to the team: each worker writes what it asks
  /// of the encodings into a table of its own.
  template <class TablesOf>
  static void reduce(const Design&, const Tables& t, In<S> input_weight, TablesOf&& dtables_of,
                     Out<S> dinput_weight, Team& team) {
    const Index channels = t.encodings.rows(), codes = t.encodings.cols();
    Tables& sum = dtables_of(0);
    team.run([&](int w) {
      const auto [from, to] = team.share(grid::kViewCells, w);
      Tables& own = dtables_of(w);
      for (Index c = from; c < to; ++c) {
        const auto dinput = sum.input.middleCols(c * codes, codes);
        dinput_weight.middleCols(c * channels, channels).noalias() +=
            dinput * t.encodings.transpose();
        own.encodings.noalias() +=
            input_weight.middleCols(c * channels, channels).transpose() * dinput;
      }
    });
    for (int w = 1; w < team.size(); ++w) sum.encodings += dtables_of(w).encodings;
  }

  static void tables_backward(const Design& d, const Tables& t, const WordTables<S>& words,
                              Tables& dt, WordTables<S>& dwords, Params& grads) {
    if (d.config.attention) {
      auto dscores = dt.scores.topRows(d.alphabet.size());
      if (d.config.gaze == Gaze::product) {
        Lexicon<S>::backward(d.config, words, t.lexicon, dt.lexicon,
                             dt.scores.topRows(nowhere(d) + 1), dwords);
      }
      dwords.probes.noalias() += t.encodings * dscores;
      dt.encodings.noalias() += words.probes * dscores.transpose();
    }
    Encoder::backward(d, t.encodings, dt.encodings, grads);
  }
};

}  // namespace wordgaze::model
