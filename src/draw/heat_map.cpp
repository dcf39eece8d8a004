#include "heat_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "color_map.hpp"
#include "wordgaze/draw/tile.hpp"

namespace wordgaze::draw {
namespace {

constexpr Rgb kLine{96, 96, 104};

/// The part of a cell's side that its tile takes: the color must keep the most of the cell.
double part_of_tile(const Tile& tile) {
  if (tile.agent) return 0.6;
  switch (tile.type) {
    case grid::Type::unseen:
    case grid::Type::empty:
    case grid::Type::floor:
      return 0;
    case grid::Type::wall:
      return 0.4;
    default:
      return 0.6;
  }
}

/// MiniGrid's lines are one pixel or less of a small tile, at its left and at its top.
Image without_lines(const Tile& tile, int size) {
  const Image whole = render(tile, size + 1);
  Image part(size, size);
  for (int y = 0; y < size; ++y) std::copy_n(whole.pixel(1, y + 1), 3 * size, part.pixel(0, y));
  return part;
}

void fill(Image& image, int x, int y, int width, int height, Rgb color) {
  for (int row = y; row < y + height; ++row) {
    for (int column = x; column < x + width; ++column) {
      std::ranges::copy(color, image.pixel(column, row));
    }
  }
}

}  // namespace

Image heat_map(std::span<const float> shares, std::span<const std::uint8_t, grid::kImageBytes> view,
               int cell_size) {
  const auto seen = [&](int x, int y) {
    return x >= 0 && y >= 0 && seen_tile(view, x, y).type != grid::Type::unseen;
  };
  Image map(grid::kViewSize * cell_size, grid::kViewSize * cell_size);
  for (int x = 0; x < grid::kViewSize; ++x) {
    for (int y = 0; y < grid::kViewSize; ++y) {
      const int left = x * cell_size, top = y * cell_size;
      fill(map, left, top, cell_size, cell_size,
           heat(shares[static_cast<std::size_t>(x * grid::kViewSize + y)]));
      if (seen(x, y) || seen(x, y - 1)) fill(map, left, top, cell_size, 1, kLine);
      if (seen(x, y) || seen(x - 1, y)) fill(map, left, top, 1, cell_size, kLine);
      const Tile tile = seen_tile(view, x, y);
      const int margin = static_cast<int>(std::lround(0.5 * (1 - part_of_tile(tile)) * cell_size));
      const int size = cell_size - 2 * margin;
      if (size > 0) map.paste(without_lines(tile, size), left + margin, top + margin);
    }
  }
  return map;
}

}  // namespace wordgaze::draw
