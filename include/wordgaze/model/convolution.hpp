#pragma once
#include <concepts>
#include <tuple>

#include <Eigen/Core>

#include "wordgaze/core/types.hpp"
#include "wordgaze/model/view_map.hpp"
#include "wordgaze/nn/parameters.hpp"

namespace wordgaze::model {

/// A 3x3 convolution with zero padding between two maps; equation (V3) in docs/math.md.
///
/// Columns of neighbors follow each other in memory, so three taps in a row see one column of 3 C
/// numbers: a convolution is three products with overlapping columns of the map itself, and the
/// usual copy of nine shifted maps is not made.
///
/// shapes   x, y maps of C columns (view_map.hpp); weight [C, 9 C], a block of C columns a tap
/// What stands between the cells of y and of dx is no result; in x and dy it must be zero.
template <std::floating_point S>
struct Convolution {
  struct Params {
    Matrix<S> weight;  ///< [C, 9 C]
    Vector<S> bias;    ///< [C]
    static constexpr auto fields() {
      return std::tuple{nn::Field{"weight", &Params::weight}, nn::Field{"bias", &Params::bias}};
    }
  };
  static void resize(Index channels, Params& p) {
    p.weight.resize(channels, kTaps * channels);
    p.bias.resize(channels);
  }

  static void forward(const Params& p, const Matrix<S>& x, Matrix<S>& y) {
    convolve(p.weight, x, y);
    map_body(y).colwise() += p.bias;
  }
  /// `turned` is turn() of the weight. Accumulates into grads (+=), overwrites dx (=).
  static void backward(In<S> turned, const Matrix<S>& x, const Matrix<S>& dy, Params& grads,
                       Matrix<S>& dx) {
    const Index width = 3 * x.rows();
    grads.bias += map_body(dy).rowwise().sum();
    for (Index row = 0; row < 3; ++row) {
      grads.weight.middleCols(row * width, width).noalias() +=
          map_body(dy) * shifted(x, row).transpose();
    }
    convolve(turned, dy, dx);
  }
  /// The weight that takes dy back to dx by a convolution.
  static void turn(In<S> weight, Out<S> turned) {
    const Index channels = weight.rows();
    for (Index tap = 0; tap < kTaps; ++tap) {
      turned.middleCols(tap * channels, channels) =
          weight.middleCols((kTaps - 1 - tap) * channels, channels).transpose();
    }
  }

 private:
  static void convolve(In<S> weight, const Matrix<S>& x, Matrix<S>& y) {
    const Index width = 3 * x.rows();
    auto out = map_body(y);
    out.noalias() = weight.leftCols(width) * shifted(x, 0);
    out.noalias() += weight.middleCols(width, width) * shifted(x, 1);
    out.noalias() += weight.rightCols(width) * shifted(x, 2);
  }
  /// Column q holds the three neighbors of slot q that taps 3 row to 3 row + 2 see.
  static auto shifted(const Matrix<S>& x, Index row) {
    const Index first = kMapMargin + tap_distance(3 * row);
    return Eigen::Map<const Matrix<S>, 0, Eigen::OuterStride<>>(x.col(first).data(), 3 * x.rows(),
                                                                x.cols() - 2 * kMapMargin,
                                                                Eigen::OuterStride<>(x.rows()));
  }
};

}  // namespace wordgaze::model
