#pragma once
#include <concepts>

#include "wordgaze/model/cell_alphabet.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// The visual encoding O~: a 1x1 convolution with ReLU over the one-hot cells of the 7x7 view;
/// equation (V) in docs/math.md. It keeps the map, and since it looks at one cell at a time it is a
/// table over the alphabet.
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
  static void forward(const Params& p, const CellAlphabet& alphabet, Out<S> table) {
    for (int k = 0; k < alphabet.size(); ++k) {
      const auto [type, color, state] = features(alphabet[k]);
      table.col(k) =
          (p.bias + p.weight.col(type) + p.weight.col(color) + p.weight.col(state)).cwiseMax(S(0));
    }
  }
  /// dtable is overwritten with the gradient before the ReLU.
  static void backward(const CellAlphabet& alphabet, In<S> table, Out<S> dtable, Params& grads) {
    dtable.array() *= (table.array() > S(0)).template cast<S>();
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
