#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/cell_encoder.hpp"
#include "wordgaze/model/convolution.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The visual encoding O~ by two 3x3 convolutions, each with a leaky ReLU: a cell's encoding sees
/// the 5x5 patch around it. Equations (V2) and (V3) in docs/math.md.
///
/// A one-hot view under the first convolution is a sum of nine columns of its weight, one a
/// neighbor. So the first layer is a table [C, 9 (codes + 1)], column tap * (codes + 1) + code,
/// whose last code stands for what lies outside the view: zeros. The second layer is a Convolution.
///
/// shapes   N frames, maps of C channels (view_map.hpp)
/// backward accumulates into grads and dtable (+=)
template <std::floating_point S>
struct PatchEncoder {
  struct Params {
    typename CellEncoder<S>::Params first;  ///< weight [C, 9 * 20]: a block of 20 columns a tap
    typename Convolution<S>::Params second;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"first", &Params::first}, nn::Field{"second", &Params::second}};
    }
  };
  /// What depends on the weights alone.
  struct Tables {
    Matrix<S> first;   // [C, 9 (codes + 1)]
    Matrix<S> turned;  // [C, 9 C] the second weight, for the way back; not as a gradient
    static constexpr auto fields() { return std::tuple{nn::Field{"first", &Tables::first}}; }
  };
  struct Cache {
    Matrix<S> hidden, output;  ///< maps: after the first layer, and O~
    Matrix<S> dhidden, doutput;
    void resize(const Design& d, Index frames) {
      for (auto* m : {&hidden, &output, &dhidden, &doutput}) {
        m->setZero(d.config.channels, map_columns(frames));
      }
    }
  };

  static void resize(const Design& d, Params& p) {
    p.first.weight.resize(d.config.channels, kTaps * kCellFeatures);
    p.first.bias.resize(d.config.channels);
    Convolution<S>::resize(d.config.channels, p.second);
  }
  static void resize(const Design& d, Tables& t) {
    t.first.setZero(d.config.channels, kTaps * (d.alphabet.size() + 1));
    t.turned.setZero(d.config.channels, kTaps * d.config.channels);
  }
  /// Near the 1x1 encoder: a cell says more than its neighbors, and the second convolution begins
  /// as the identity with small random weights around it.
  static void initialize(const Design& d, core::Rng& rng, Params& p) {
    nn::fill_uniform(p.first.weight, 0.1, rng);
    auto center = p.first.weight.middleCols(kTaps / 2 * kCellFeatures, kCellFeatures);
    nn::fill_uniform(center, 0.5, rng);
    p.first.bias.setConstant(static_cast<S>(d.config.encoder_bias));
    nn::fill_scaled(p.second.weight, 0.3, rng);
    p.second.weight.middleCols(kTaps / 2 * d.config.channels, d.config.channels)
        .diagonal()
        .array() += S(1);
  }
  static void set_object_channel(const Design& d, Params& p) {
    auto& [first, second] = p;
    first.weight.row(0).setZero();
    first.weight.row(0).segment(kTaps / 2 * kCellFeatures + kFirstObject, kObjectTypes).setOnes();
    first.bias(0) = 0;
    second.weight.row(0).setZero();
    second.weight(0, kTaps / 2 * d.config.channels) = 1;
  }

  static void refresh(const Design& d, const Params& p, Tables& t) {
    const CellAlphabet& alphabet = d.alphabet;
    for (Index tap = 0; tap < kTaps; ++tap) {
      const auto weight = p.first.weight.middleCols(tap * kCellFeatures, kCellFeatures);
      for (int code = 0; code < alphabet.size(); ++code) {
        const auto [type, color, state] = features(alphabet[code]);
        t.first.col(tap * (alphabet.size() + 1) + code) =
            weight.col(type) + weight.col(color) + weight.col(state);
      }
    }
    Convolution<S>::turn(p.second.weight, t.turned);
  }
  static void tables_backward(const Design& d, const Tables& dt, Params& grads) {
    for (Index tap = 0; tap < kTaps; ++tap) {
      auto weight = grads.first.weight.middleCols(tap * kCellFeatures, kCellFeatures);
      for (int code = 0; code < d.alphabet.size(); ++code) {
        const auto column = dt.first.col(tap * (d.alphabet.size() + 1) + code);
        for (const int row : features(d.alphabet[code])) weight.col(row) += column;
      }
    }
  }

  static void forward(const Design& d, const Params& p, const Tables& t, const CellMatrix& cells,
                      Cache& k) {
    const Index codes = t.first.cols() / kTaps;
    for (Index n = 0; n < cells.cols(); ++n) {
      const Around around(cells, n, codes - 1);
      auto hidden = map_frame(k.hidden, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const auto term = [&](Index tap) { return t.first.col(tap * codes + around(cell, tap)); };
        hidden.col(map_slot(cell)) = p.first.bias + ((term(0) + term(1)) + (term(2) + term(3))) +
                                     ((term(4) + term(5)) + (term(6) + term(7))) + term(8);
      }
    }
    // Slots between the cells stay zero.
    const S leak = leak_of(d);
    map_body(k.hidden) = map_body(k.hidden).cwiseMax(leak * map_body(k.hidden));
    Convolution<S>::forward(p.second, k.hidden, k.output);
    auto y = map_body(k.output);
    y = y.cwiseMax(leak * y);
  }

  /// On entry cache.doutput is the gradient of O~, zero between the cells; it is used up.
  static void backward(const Design& d, const Params&, const Tables& t, const CellMatrix& cells,
                       Cache& k, Params& grads, Tables& dt) {
    const auto through = [leak = leak_of(d)](const Matrix<S>& y, Matrix<S>& dy) {
      map_body(dy) = (map_body(y).array() > S(0)).select(map_body(dy), leak * map_body(dy));
    };
    through(k.output, k.doutput);
    Convolution<S>::backward(t.turned, k.hidden, k.doutput, grads.second, k.dhidden);
    through(k.hidden, k.dhidden);
    const Index codes = t.first.cols() / kTaps;
    for (Index n = 0; n < cells.cols(); ++n) {
      const Around around(cells, n, codes - 1);
      const auto dhidden = map_frame(k.dhidden, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const auto dy = dhidden.col(map_slot(cell));
        grads.first.bias += dy;
        for (Index tap = 0; tap < kTaps; ++tap) {
          dt.first.col(tap * codes + around(cell, tap)) += dy;
        }
      }
    }
  }

 private:
  static S leak_of(const Design& d) { return static_cast<S>(d.config.encoder_leak); }

  /// The codes around each cell of a frame, with one more code outside of the view.
  class Around {
   public:
    Around(const CellMatrix& cells, Index n, Index outside) {
      codes_.fill(static_cast<std::uint8_t>(outside));
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        codes_[static_cast<std::size_t>(kMapMargin + map_slot(cell))] = cells(cell, n);
      }
    }
    Index operator()(Index cell, Index tap) const {
      return codes_[static_cast<std::size_t>(kMapMargin + map_slot(cell) + tap_distance(tap))];
    }

   private:
    std::array<std::uint8_t, kMapSlots + 2 * kMapMargin> codes_;
  };
};

}  // namespace wordgaze::model
