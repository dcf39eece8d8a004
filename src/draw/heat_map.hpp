#pragma once
#include <cstdint>
#include <span>

#include "wordgaze/draw/image.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::draw {

/// 49 shares as colors of the bar, with nothing mixed in. What lies in a cell is shown small in its
/// middle, walls as a smaller square; cells that the agent does not see have no lines.
Image heat_map(std::span<const float> shares, std::span<const std::uint8_t, grid::kImageBytes> view,
               int cell_size);

}  // namespace wordgaze::draw
