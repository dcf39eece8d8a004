#pragma once
#include <concepts>
#include <tuple>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/design.hpp"
#include "wordgaze/model/view_map.hpp"
#include "wordgaze/model/word_tables.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// What an encoder of views need not say if it has no tables and keeps nothing but its map:
/// inherit.
template <std::floating_point S>
struct PlainMapEncoder {
  struct Tables {
    static constexpr auto fields() { return std::tuple<>(); }
  };
  struct Cache {
    Matrix<S> output, doutput;  ///< maps of C channels (view_map.hpp)
    void resize(const Design& d, Index frames) {
      for (auto* m : {&output, &doutput}) m->setZero(d.config.channels, map_columns(frames));
    }
  };
  static void resize(const Design&, Tables&) {}
  template <class Params>
  static void refresh(const Design&, const Params&, Tables&) {}
  template <class Params>
  static void tables_backward(const Design&, const Tables&, Params&) {}
};

/// Vision (vision.hpp) by an encoder of whole views, whose encoding of a cell may depend on all 49:
/// a map of C channels a frame (view_map.hpp). Scores compare it with the probes, the filtered view
/// F = O~ * s(M), equation (F1), is formed and multiplied with W_x as any matrix is.
///
/// The entries of a map of attention are the slots of the view; each occurs once.
///
/// An encoder has
///
///     Params, Tables with fields();  Cache with maps output and doutput, and resize(design,
///     frames) resize(design, Params&), resize(design, Tables&), initialize(design, rng, Params&)
///     set_object_channel(design, Params&)   channel 0 becomes 1 on objects: for the object prior
///     refresh(design, params, tables)       what depends on the weights alone
///     forward(design, params, tables, cells, cache)
///     backward(design, params, tables, cells, cache, grads, dtables)     all accumulated
///     tables_backward(design, dtables, grads)
///
/// What lies between the cells of output does not count; doutput is zero there on entry.
template <std::floating_point S, template <class> class EncoderOf>
struct MapVision {
  using Encoder = EncoderOf<S>;
  using Params = typename Encoder::Params;
  using Tables = typename Encoder::Tables;
  struct Cache {
    typename Encoder::Cache encoder;
    Matrix<S> counts;               ///< [P, N] 1 where a slot is a cell
    Vector<S> score;                // [P] of one word
    Matrix<S> filtered, dfiltered;  // [49 C, N]: F
  };

  static void resize(const Design& d, Params& p) { Encoder::resize(d, p); }
  static void resize(const Design& d, Tables& t) { Encoder::resize(d, t); }
  static void resize(const Design& d, Index frames, Cache& k) {
    k.encoder.resize(d, frames);
    k.score.setZero(kMapSlots);
    for (auto* m : {&k.filtered, &k.dfiltered}) {
      m->resize(grid::kViewCells * d.config.channels, frames);
    }
    k.counts.setZero(kMapSlots, frames);
    for (Index cell = 0; cell < grid::kViewCells; ++cell) k.counts.row(map_slot(cell)).setOnes();
  }
  static void initialize(const Design& d, core::Rng& rng, Params& p) {
    Encoder::initialize(d, rng, p);
  }
  static void set_object_channel(const Design& d, Params& p) { Encoder::set_object_channel(d, p); }

  static Index entries(const Design&) { return kMapSlots; }
  static Index nowhere(const Design&) { return -1; }
  static Index entry(const Design&, const CellMatrix&, Index cell, Index) { return map_slot(cell); }
  static auto encoding(const Design&, const Tables&, const Cache& k, const CellMatrix&, Index cell,
                       Index n) {
    return map_frame(k.encoder.output, n).col(map_slot(cell));
  }

  static void refresh(const Design& d, const Params& p, const WordTables<S>&,
                      In<S> /*input_weight*/, Tables& t, Team&) {
    Encoder::refresh(d, p, t);
  }
  static void forward(const Design& d, const Params& p, const Tables& t, const CellMatrix& cells,
                      Cache& k) {
    Encoder::forward(d, p, t, cells, k.encoder);
  }

  template <class F>
  static void with_scores(const Design&, const Tables&, const WordTables<S>& words,
                          const CellMatrix&, Cache& k, F&& f) {
    f(k.counts, [&](Index n, Index word) -> const Vector<S>& {
      k.score.noalias() = map_frame(k.encoder.output, n).transpose() * words.probes.col(word);
      return k.score;
    });
  }

  static void read(const Design&, const Tables&, In<S> input_weight, const CellMatrix&, In<S> scale,
                   Cache& k, Out<S> product) {
    const Index channels = k.encoder.output.rows();
    for (Index n = 0; n < k.filtered.cols(); ++n) {
      const auto view = map_frame(k.encoder.output, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const Index slot = map_slot(cell);
        k.filtered.col(n).segment(cell * channels, channels) = scale(slot, n) * view.col(slot);
      }
    }
    product.noalias() = input_weight * k.filtered;
  }
  static void read_backward(const Design&, const Tables&, In<S> input_weight, const CellMatrix&,
                            In<S> scale, In<S> dproduct, Cache& k, Matrix<S>& dinput_weight,
                            Tables&, Out<S> dscale) {
    dinput_weight.noalias() += dproduct * k.filtered.transpose();
    k.dfiltered.noalias() = input_weight.transpose() * dproduct;
    const Index channels = k.encoder.output.rows();
    for (Index n = 0; n < k.dfiltered.cols(); ++n) {
      const auto view = map_frame(k.encoder.output, n);
      auto dview = map_frame(k.encoder.doutput, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const Index slot = map_slot(cell);
        const auto df = k.dfiltered.col(n).segment(cell * channels, channels);
        dscale(slot, n) = df.dot(view.col(slot));
        dview.col(slot) = scale(slot, n) * df;
      }
    }
  }

  template <class F>
  static void with_score_gradients(const Design&, const Tables&, const WordTables<S>& words,
                                   Cache& k, Tables&, WordTables<S>& dwords, F&& f) {
    f(k.counts, [&](Index n, Index word, const auto& dscore) {
      k.score = dscore;
      map_frame(k.encoder.doutput, n).noalias() += words.probes.col(word) * k.score.transpose();
      dwords.probes.col(word).noalias() += map_frame(k.encoder.output, n) * k.score;
    });
  }

  static void backward(const Design& d, const Params& p, const Tables& t, const CellMatrix& cells,
                       Cache& k, Params& grads, Tables& dt) {
    Encoder::backward(d, p, t, cells, k.encoder, grads, dt);
  }

  static bool input_weight_from_tables(const Design&) { return false; }

  template <class TablesOf>
  static void reduce(const Design&, const Tables&, In<S>, TablesOf&&, Out<S>, Team&) {}

  static void tables_backward(const Design& d, const Tables&, const WordTables<S>&, Tables& dt,
                              WordTables<S>&, Params& grads) {
    Encoder::tables_backward(d, dt, grads);
  }
};

}  // namespace wordgaze::model
