#pragma once
#include <concepts>

#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The visual encoding O~: a 1x1 convolution over the one-hot cells of the 7x7 view, linear or with
/// a leaky ReLU; equation (V) in docs/math.md. Linear by default: else one object of eighteen may
/// become an exception that is never found (docs/reading.md). It keeps the map, and since it looks
/// at one cell at a time it is a table over the alphabet.
///
/// shapes   table [C, P]: the encoding of each of the P codes
/// backward accumulates into grads (+=)
template <std::floating_point S>
struct VisualEncoder {
  struct Params {
    Matrix<S> weight;  ///< [C, 20]: rows of type, color and state, one-hot
    Vector<S> bias;    ///< [C]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"weight", &Params::weight}, nn::Field{"bias", &Params::bias}};
    }
  };
  static void resize(Params& p, Index channels) {
    p.weight.resize(channels, kCellFeatures);
    p.bias.resize(channels);
  }
  static void forward(const Params& p, const CellAlphabet& alphabet, S leak, Out<S> table) {
    for (int k = 0; k < alphabet.size(); ++k) {
      const auto [type, color, state] = features(alphabet[k]);
      table.col(k) = p.bias + p.weight.col(type) + p.weight.col(color) + p.weight.col(state);
    }
    table = table.cwiseMax(leak * table);
  }
  /// dtable is overwritten with the gradient before the leaky ReLU.
  static void backward(const CellAlphabet& alphabet, S leak, In<S> table, Out<S> dtable,
                       Params& grads) {
    dtable = (table.array() > S(0)).select(dtable, leak * dtable);
    for (int k = 0; k < alphabet.size(); ++k) {
      for (const int row : features(alphabet[k])) grads.weight.col(row) += dtable.col(k);
      grads.bias += dtable.col(k);
    }
  }

  /// The three rows of `weight`'s input that are 1 for a cell.
  static std::array<int, 3> features(const CellAlphabet::Code& code) {
    return {code.type, kTypes + code.color, kTypes + kColors + code.state};
  }
};

}  // namespace wordgaze::model
