#pragma once
#include "wordgaze/model/view_map.hpp"

namespace wordgaze::model {

/// The filter F = O~ * s(M), cell by cell, for encodings that see neighbors; equation (F1) in
/// docs/math.md. F is formed and multiplied with the memory's input weight as any matrix is; where
/// an encoding looks at one cell at a time, FilteredInput does without.
///
/// shapes   map of C channels (view_map.hpp)   scale [64, N], one a slot   filtered [49 C, N]
template <std::floating_point S>
struct FilteredMap {
  static void forward(const Matrix<S>& map, In<S> scale, Matrix<S>& filtered) {
    const Index channels = map.rows();
    for (Index n = 0; n < filtered.cols(); ++n) {
      const auto view = map_frame(map, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const Index slot = map_slot(cell);
        filtered.col(n).segment(cell * channels, channels) = scale(slot, n) * view.col(slot);
      }
    }
  }
  /// Overwrites the cells of dmap and dscale; both are left zero between the cells if they were.
  static void backward(const Matrix<S>& map, In<S> scale, const Matrix<S>& dfiltered,
                       Matrix<S>& dmap, Out<S> dscale) {
    const Index channels = map.rows();
    for (Index n = 0; n < dfiltered.cols(); ++n) {
      const auto view = map_frame(map, n);
      auto dview = map_frame(dmap, n);
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        const Index slot = map_slot(cell);
        const auto df = dfiltered.col(n).segment(cell * channels, channels);
        dscale(slot, n) = df.dot(view.col(slot));
        dview.col(slot) = scale(slot, n) * df;
      }
    }
  }
};

}  // namespace wordgaze::model
