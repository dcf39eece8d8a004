#include "wordgaze/grid/grid.hpp"

#include <algorithm>

namespace wordgaze::grid {

void Grid::clear(int width, int height) {
  width_ = width;
  height_ = height;
  // The last row's right frame ends the array.
  cells_.assign(static_cast<std::size_t>((height + 2 * kFrame) * stride() + kFrame), kWall);
  for (int y = 0; y < height; ++y) {
    std::fill_n(cells_.begin() + static_cast<std::ptrdiff_t>(index(at(0, y))), width, kNothing);
  }
}

bool Grid::is_framed() const {
  constexpr int kMaxSide = 1024;
  if (width_ < 1 || height_ < 1 || width_ > kMaxSide || height_ > kMaxSide) return false;
  Grid whole;
  whole.clear(width_, height_);
  if (cells_.size() != whole.cells_.size()) return false;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    // Inside, anything may stand.
    if (whole.cells_[i] == kWall && cells_[i] != kWall) return false;
  }
  return true;
}

void Grid::wall_rectangle(Position corner, int width, int height) {
  wall_row(corner, width);
  wall_row(corner + at(0, height - 1), width);
  wall_column(corner, height);
  wall_column(corner + at(width - 1, 0), height);
}

void Grid::wall_row(Position start, int length) {
  for (int i = 0; i < length; ++i) (*this)[start + at(i, 0)] = kWall;
}

void Grid::wall_column(Position start, int length) {
  for (int i = 0; i < length; ++i) (*this)[start + at(0, i)] = kWall;
}

}  // namespace wordgaze::grid
