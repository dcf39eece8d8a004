#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wordgaze/grid/world.hpp"

namespace wordgaze::bot {

/// The cells that have been in the agent's view so far: the bot plans as if it knew no others.
class Seen {
 public:
  Seen(int width, int height)
      : width_(width), cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  /// Adds what the agent sees now.
  void look(const grid::World& world);

  bool operator[](grid::Position p) const { return cells_[index(p)] != 0; }

 private:
  std::size_t index(grid::Position p) const { return static_cast<std::size_t>(p.y * width_ + p.x); }

  int width_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace wordgaze::bot
