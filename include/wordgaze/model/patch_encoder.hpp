#pragma once
#include "wordgaze/model/convolution.hpp"
#include "wordgaze/model/visual_encoder.hpp"

namespace wordgaze::model {

/// The visual encoding O~ by two 3x3 convolutions, each with a leaky ReLU: a cell's encoding sees
/// the 5x5 patch around it. Equations (V2) and (V3) in docs/math.md.
///
/// A one-hot view under the first convolution is a sum of nine columns of its weight, one a
/// neighbor. So the first layer is a table [C, 9 (P + 1)], column tap * (P + 1) + code, whose last
/// code stands for what lies outside the view: zeros. The second layer is a Convolution.
///
/// shapes   N frames, maps of C channels (view_map.hpp)
/// backward accumulates into grads and dtable (+=)
template <std::floating_point S>
struct PatchEncoder {
  struct Params {
    typename VisualEncoder<S>::Params first;  ///< weight [C, 9 * 20]: a block of 20 columns a tap
    typename Convolution<S>::Params second;
    static constexpr auto fields() {
      return std::tuple{nn::Field{"first", &Params::first}, nn::Field{"second", &Params::second}};
    }
  };
  static void resize(Params& p, Index channels) {
    p.first.weight.resize(channels, kTaps * kCellFeatures);
    p.first.bias.resize(channels);
    Convolution<S>::resize(p.second, channels);
  }

  /// What depends on the weights alone.
  struct Tables {
    Matrix<S> first;   // [C, 9 (P + 1)]
    Matrix<S> turned;  // [C, 9 C] the second weight, for the way back
    void resize(Index channels, Index codes) {
      first.setZero(channels, kTaps * (codes + 1));
      turned.setZero(channels, kTaps * channels);
    }
  };
  static void make_tables(const Params& p, const CellAlphabet& alphabet, Tables& t) {
    for (Index tap = 0; tap < kTaps; ++tap) {
      const auto weight = p.first.weight.middleCols(tap * kCellFeatures, kCellFeatures);
      for (int code = 0; code < alphabet.size(); ++code) {
        const auto [type, color, state] = VisualEncoder<S>::features(alphabet[code]);
        t.first.col(tap * (alphabet.size() + 1) + code) =
            weight.col(type) + weight.col(color) + weight.col(state);
      }
    }
    Convolution<S>::turn(p.second.weight, t.turned);
  }
  static void tables_backward(const CellAlphabet& alphabet, const Tables& dt, Params& grads) {
    for (Index tap = 0; tap < kTaps; ++tap) {
      auto weight = grads.first.weight.middleCols(tap * kCellFeatures, kCellFeatures);
      for (int code = 0; code < alphabet.size(); ++code) {
        const auto column = dt.first.col(tap * (alphabet.size() + 1) + code);
        for (const int row : VisualEncoder<S>::features(alphabet[code])) weight.col(row) += column;
      }
    }
  }

  struct Cache {
    Matrix<S> hidden, output;  ///< maps: after the first layer, and O~
    Matrix<S> dhidden, doutput;
    void resize(Index channels, Index frames) {
      for (auto* m : {&hidden, &output, &dhidden, &doutput}) {
        m->setZero(channels, map_columns(frames));
      }
    }
  };

  static void forward(const Params& p, const Tables& t, const CellMatrix& cells, S leak, Cache& k) {
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
    map_body(k.hidden) = map_body(k.hidden).cwiseMax(leak * map_body(k.hidden));
    Convolution<S>::forward(p.second.weight, k.hidden, k.output);
    auto y = map_body(k.output);
    y.colwise() += p.second.bias;
    y = y.cwiseMax(leak * y);
  }

  /// On entry cache.doutput is the gradient of O~, zero between the cells; it is used up.
  static void backward(const Tables& t, const CellMatrix& cells, S leak, Cache& k, Params& grads,
                       Tables& dt) {
    const auto through = [leak](const Matrix<S>& y, Matrix<S>& dy) {
      map_body(dy) = (map_body(y).array() > S(0)).select(map_body(dy), leak * map_body(dy));
    };
    through(k.output, k.doutput);
    grads.second.bias += map_body(k.doutput).rowwise().sum();
    Convolution<S>::backward_weight(k.hidden, k.doutput, grads.second.weight);
    Convolution<S>::forward(t.turned, k.doutput, k.dhidden);
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
