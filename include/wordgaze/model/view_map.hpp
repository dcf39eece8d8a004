#pragma once
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/cell_alphabet.hpp"

/// Feature maps over whole views, laid out so that a 3x3 convolution is three plain products.
///
/// A frame has 64 slots: the 7 cells of each view column and a slot of zeros behind them, and a
/// last column of zeros. So every neighbor of a cell lies at one fixed distance, also across the
/// border of the view, and zero padding is in place. Zeros in front of the first frame and behind
/// the last serve the borders there.
///
/// shapes   [C, kMapMargin + 64 N + kMapMargin], one column a slot
namespace wordgaze::model {

inline constexpr int kMapStride = grid::kViewSize + 1;
inline constexpr int kMapSlots = kMapStride * kMapStride;  ///< of a frame
inline constexpr int kMapMargin = kMapStride + 1;          ///< the farthest neighbor
inline constexpr int kTaps = 9;                            ///< of a 3x3 kernel
static_assert(kMapSlots <= kMaxCodes, "attention has room for a number a slot");

/// The slot of a cell within its frame.
constexpr Index map_slot(Index cell) {
  return cell / grid::kViewSize * kMapStride + cell % grid::kViewSize;
}

/// How far the neighbor of a tap lies: taps go from (-1,-1) to (1,1), the second offset fastest.
constexpr Index tap_distance(Index tap) { return (tap / 3 - 1) * kMapStride + tap % 3 - 1; }

constexpr Index map_columns(Index frames) { return frames * kMapSlots + 2 * kMapMargin; }

/// The slots of all frames, without the margins.
template <class M>
auto map_body(M& map) {
  return map.middleCols(kMapMargin, map.cols() - 2 * kMapMargin);
}
/// The 64 slots of frame n.
template <class M>
auto map_frame(M& map, Index n) {
  return map.middleCols(kMapMargin + n * kMapSlots, kMapSlots);
}

}  // namespace wordgaze::model
