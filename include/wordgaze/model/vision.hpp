#pragma once
#include <concepts>
#include <tuple>
#include <utility>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/map_vision.hpp"
#include "wordgaze/model/patch_encoder.hpp"
#include "wordgaze/model/table_vision.hpp"
#include "wordgaze/model/word_tables.hpp"
#include "wordgaze/nn/parameters.hpp"

/// Vision: the block that encodes the view, compares it with words, and hands what attention leaves
/// of it to the memory. Two types: TableVision and MapVision; and ConfiguredVision, which is the
/// one that a configuration asks for. Another one is another encoder for one of the two, or another
/// type with the same calls, and an Agent<S, ThatType>.
///
/// A map of attention has P entries, the numbers that cells share: `entry(cell)` is the one of a
/// cell and `counts` says how many cells have it.
///
///     Params, Tables with fields(); Cache      tables depend on the weights alone; a gradient has
///                                              the same types
///     refresh        params, probes, W_x -> tables
///     forward        cells -> O~, into the cache
///     with_scores    calls f(counts [P, N], score_of(n, word) -> [P]): (A1)
///     read           scale s(M) [P, N] -> product W_x (O~ * s) [4 H, N]: (F1), (F2)
///
/// and read from the bottom up, gradients accumulated but for dscale:
///
///     read_backward           dproduct -> dscale [P, N] summed over the cells of an entry, dW_x,
///     and
///                             what dtables or the cache hold of it
///     with_score_gradients    calls f(counts, take(n, word, dscore [P])), from where they go to
///     dprobes backward                what the cache holds -> grads, dtables reduce the large
///     tables of all workers -> dW_x, on the team tables_backward         dtables -> grads, dprobes
///
/// shapes   N frames, P entries, C channels, V words of the vocabulary; probes [C, V], W_x [4 H, 49
/// C]
namespace wordgaze::model {

template <std::floating_point S>
struct ConfiguredVision {
  using Cells = TableVision<S, CellEncoder>;
  using Patches = MapVision<S, PatchEncoder>;

  /// Of the type that is not in use all matrices are empty.
  struct Params {
    typename Cells::Params cells;
    typename Patches::Params patches;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"visual", &Params::cells},
                        nn::Field{"patches", &Params::patches}};
    }
  };
  struct Tables {
    typename Cells::Tables cells;
    typename Patches::Tables patches;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"cells", &Tables::cells}, nn::Field{"patches", &Tables::patches}};
    }
  };
  struct Cache {
    typename Cells::Cache cells;
    typename Patches::Cache patches;
  };

  /// Calls f(vision, its), where its(x) is the part of Params, Tables or Cache that is this
  /// vision's.
  template <class F>
  static decltype(auto) choose(const Design& d, F&& f) {
    switch (d.config.encoder) {
      case Encoder::patch:
        return f(
            Patches{}, [](auto& all) -> auto& { return all.patches; });
      case Encoder::cell:
        break;
    }
    return f(
        Cells{}, [](auto& all) -> auto& { return all.cells; });
  }

  static void resize(const Design& d, Params& p) {
    choose(d, [&](auto vision, auto its) { vision.resize(d, its(p)); });
  }
  static void resize(const Design& d, Tables& t) {
    choose(d, [&](auto vision, auto its) { vision.resize(d, its(t)); });
  }
  static void resize(const Design& d, Index frames, Cache& k) {
    choose(d, [&](auto vision, auto its) { vision.resize(d, frames, its(k)); });
  }
  static void initialize(const Design& d, core::Rng& rng, Params& p) {
    choose(d, [&](auto vision, auto its) { vision.initialize(d, rng, its(p)); });
  }
  static void set_object_channel(const Design& d, Params& p) {
    choose(d, [&](auto vision, auto its) { vision.set_object_channel(d, its(p)); });
  }
  static Index entries(const Design& d) {
    return choose(d, [&](auto vision, auto) { return vision.entries(d); });
  }
  /// The entry that is no cell; -1 where there is none.
  static Index nowhere(const Design& d) {
    return choose(d, [&](auto vision, auto) { return vision.nowhere(d); });
  }
  static Index entry(const Design& d, const CellMatrix& cells, Index cell, Index n) {
    return choose(d, [&](auto vision, auto) { return vision.entry(d, cells, cell, n); });
  }
  static Vector<S> encoding(const Design& d, const Tables& t, const Cache& k,
                            const CellMatrix& cells, Index cell, Index n) {
    return choose(d, [&](auto vision, auto its) -> Vector<S> {
      return vision.encoding(d, its(t), its(k), cells, cell, n);
    });
  }

  static void refresh(const Design& d, const Params& p, const WordTables<S>& words,
                      In<S> input_weight, Tables& t, Team& team) {
    choose(d, [&](auto vision, auto its) {
      vision.refresh(d, its(p), words, input_weight, its(t), team);
    });
  }
  static void forward(const Design& d, const Params& p, const Tables& t, const CellMatrix& cells,
                      Cache& k) {
    choose(d, [&](auto vision, auto its) { vision.forward(d, its(p), its(t), cells, its(k)); });
  }
  template <class F>
  static void with_scores(const Design& d, const Tables& t, const WordTables<S>& words,
                          const CellMatrix& cells, Cache& k, F&& f) {
    choose(d, [&](auto vision, auto its) {
      vision.with_scores(d, its(t), words, cells, its(k), std::forward<F>(f));
    });
  }
  static void read(const Design& d, const Tables& t, In<S> input_weight, const CellMatrix& cells,
                   In<S> scale, Cache& k, Out<S> product) {
    choose(d, [&](auto vision, auto its) {
      vision.read(d, its(t), input_weight, cells, scale, its(k), product);
    });
  }

  static void read_backward(const Design& d, const Tables& t, In<S> input_weight,
                            const CellMatrix& cells, In<S> scale, In<S> dproduct, Cache& k,
                            Matrix<S>& dinput_weight, Tables& dt, Out<S> dscale) {
    choose(d, [&](auto vision, auto its) {
      vision.read_backward(d, its(t), input_weight, cells, scale, dproduct, its(k), dinput_weight,
                           its(dt), dscale);
    });
  }
  template <class F>
  static void with_score_gradients(const Design& d, const Tables& t, const WordTables<S>& words,
                                   Cache& k, Tables& dt, WordTables<S>& dwords, F&& f) {
    choose(d, [&](auto vision, auto its) {
      vision.with_score_gradients(d, its(t), words, its(k), its(dt), dwords, std::forward<F>(f));
    });
  }
  static void backward(const Design& d, const Params& p, const Tables& t, const CellMatrix& cells,
                       Cache& k, Params& grads, Tables& dt) {
    choose(d, [&](auto vision, auto its) {
      vision.backward(d, its(p), its(t), cells, its(k), its(grads), its(dt));
    });
  }
  /// Whether reduce() alone gives the gradient of W_x: then only one worker needs room for it.
  static bool input_weight_from_tables(const Design& d) {
    return choose(d, [&](auto vision, auto) { return vision.input_weight_from_tables(d); });
  }
  template <class TablesOf>
  static void reduce(const Design& d, const Tables& t, In<S> input_weight, TablesOf&& dtables_of,
                     Out<S> dinput_weight, Team& team) {
    choose(d, [&](auto vision, auto its) {
      const auto own = [&](int worker) -> auto& { return its(dtables_of(worker)); };
      vision.reduce(d, its(t), input_weight, own, dinput_weight, team);
    });
  }
  static void tables_backward(const Design& d, const Tables& t, const WordTables<S>& words,
                              Tables& dt, WordTables<S>& dwords, Params& grads) {
    choose(d, [&](auto vision, auto its) {
      vision.tables_backward(d, its(t), words, its(dt), dwords, its(grads));
    });
  }
};

}  // namespace wordgaze::model
