#pragma once
#include <array>
#include <concepts>
#include <tuple>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/design.hpp"
#include "wordgaze/nn/initialize.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The rows of a one-hot cell [20] that are 1: type, color and state.
inline std::array<int, 3> features(const CellAlphabet::Code& code) {
  return {code.type, kTypes + code.color, kTypes + kColors + code.state};
}
/// Rows of key, ball and box, the types that an object prior is about.
inline constexpr Index kFirstObject = 5, kObjectTypes = 3;

/// The visual encoding O~ by a 1x1 convolution over the one-hot cells of the 7x7 view, linear or
/// with a leaky ReLU; equation (V) in docs/math.md. Linear by default: else one object of eighteen
/// may become an exception that is never found (docs/reading.md). It keeps the map, and since it
/// looks at one cell at a time it is a table over the alphabet (table_vision.hpp).
///
/// shapes   table [C, codes]: the encoding of each code
/// backward accumulates into grads (+=)
template <std::floating_point S>
struct CellEncoder {
  struct Params {
    Matrix<S> weight;  ///< [C, 20]: rows of type, color and state, one-hot
    Vector<S> bias;    ///< [C]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"weight", &Params::weight}, nn::Field{"bias", &Params::bias}};
    }
  };

  static void resize(const Design& d, Params& p) {
    p.weight.resize(d.config.channels, kCellFeatures);
    p.bias.resize(d.config.channels);
  }
  static void initialize(const Design& d, core::Rng& rng, Params& p) {
    nn::fill_uniform(p.weight, 0.5, rng);
    p.bias.setConstant(static_cast<S>(d.config.encoder_bias));
  }
  /// Channel 0 becomes 1 on key, ball and box, and 0 elsewhere.
  static void set_object_channel(Params& p) {
    p.weight.row(0).setZero();
    p.weight.row(0).segment(kFirstObject, kObjectTypes).setOnes();
    p.bias(0) = 0;
  }

  static void forward(const Design& d, const Params& p, Out<S> table) {
    for (int k = 0; k < d.alphabet.size(); ++k) {
      const auto [type, color, state] = features(d.alphabet[k]);
      table.col(k) = p.bias + p.weight.col(type) + p.weight.col(color) + p.weight.col(state);
    }
    table = table.cwiseMax(leak(d) * table);
  }
  /// dtable is overwritten with the gradient before the leaky ReLU.
  static void backward(const Design& d, In<S> table, Out<S> dtable, Params& grads) {
    dtable = (table.array() > S(0)).select(dtable, leak(d) * dtable);
    for (int k = 0; k < d.alphabet.size(); ++k) {
      for (const int row : features(d.alphabet[k])) grads.weight.col(row) += dtable.col(k);
      grads.bias += dtable.col(k);
    }
  }

 private:
  static S leak(const Design& d) { return static_cast<S>(d.config.encoder_leak); }
};

}  // namespace wordgaze::model
