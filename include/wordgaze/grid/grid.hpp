#pragma once
#include <cstddef>
#include <vector>

#include "wordgaze/grid/object.hpp"

namespace wordgaze::grid {

/// Which object stands in each cell, in a frame of walls as wide as the agent sees far: whatever it
/// looks at is in memory, and what lies outside reads as wall.
class Grid {
 public:
  static constexpr int kFrame = 6;

  /// Makes all cells of a grid of this size empty.
  void clear(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  bool contains(Position p) const { return p.x >= 0 && p.x < width_ && p.y >= 0 && p.y < height_; }

  /// The object in a cell; the position may lie up to kFrame cells outside.
  ObjectId operator[](Position p) const { return cells_[index(p)]; }
  ObjectId& operator[](Position p) { return cells_[index(p)]; }

  /// For those who walk the cells themselves: row y + 1 is stride() cells behind row y.
  const ObjectId* pointer(Position p) const { return cells_.data() + index(p); }
  ObjectId* pointer(Position p) { return cells_.data() + index(p); }
  int stride() const { return width_ + kFrame; }

  /// Walls along the border of a rectangle.
  void wall_rectangle(Position corner, int width, int height);
  void wall_row(Position start, int length);
  void wall_column(Position start, int length);

  /// Whether all cells are there, and walls all around: what a restored grid is asked.
  bool is_framed() const;

  /// Walks all members, to store or restore them.
  template <class Archive>
  void archive(Archive& archive) {
    archive(width_, height_, cells_);
  }
  template <class Archive>
  void archive(Archive& archive) const {
    archive(width_, height_, cells_);
  }

 private:
  // The frame at the right of a row is also the frame at the left of the next.
  std::size_t index(Position p) const {
    return static_cast<std::size_t>((p.y + kFrame) * stride() + p.x + kFrame);
  }

  int width_ = 0, height_ = 0;
  std::vector<ObjectId> cells_;
};

}  // namespace wordgaze::grid
