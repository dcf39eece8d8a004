#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "wordgaze/core/require.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::policy {

/// What one cell of a view shows.
struct Cell {
  grid::Type type = grid::Type::empty;
  grid::Color color = grid::Color::red;
  grid::DoorState state = grid::DoorState::open;  ///< doors only, else open

  bool operator==(const Cell&) const = default;
};

/// The number of cell (x, y) of a view in lists of 49, as in gazes and maps: x by x.
inline std::size_t cell_index(int x, int y) {
  require(x >= 0 && x < grid::kViewSize && y >= 0 && y < grid::kViewSize,
          "view: cell ({}, {}); expected 0 to {} each", x, y, grid::kViewSize - 1);
  return static_cast<std::size_t>(x * grid::kViewSize + y);
}

/// The 7x7 view of an agent as bytes, [x][y][type, color, state], built cell by cell. The agent
/// stands at (3, 6) and looks toward y = 0; x grows to its right. What it carries shows in its own
/// cell, which is empty otherwise.
struct View {
  static constexpr int kAgentX = grid::kViewSize / 2, kAgentY = grid::kViewSize - 1;

  std::array<std::uint8_t, grid::kImageBytes> image{};  ///< nothing is seen

  /// An empty floor, all of it seen.
  static View floor() {
    View view;
    for (int x = 0; x < grid::kViewSize; ++x) {
      for (int y = 0; y < grid::kViewSize; ++y) view.put(x, y, Cell{});
    }
    return view;
  }

  void put(int x, int y, Cell cell) {
    const std::size_t i = 3 * cell_index(x, y);
    image[i] = static_cast<std::uint8_t>(cell.type);
    image[i + 1] = static_cast<std::uint8_t>(cell.color);
    image[i + 2] = static_cast<std::uint8_t>(cell.state);
  }
  Cell at(int x, int y) const {
    const std::size_t i = 3 * cell_index(x, y);
    return {static_cast<grid::Type>(image[i]), static_cast<grid::Color>(image[i + 1]),
            static_cast<grid::DoorState>(image[i + 2])};
  }
  /// Shows a wall, which is grey.
  void wall(int x, int y) { put(x, y, {grid::Type::wall, grid::Color::grey}); }
  /// Shows an object in the agent's hand.
  void carry(Cell cell) { put(kAgentX, kAgentY, cell); }
  Cell carried() const { return at(kAgentX, kAgentY); }
};

}  // namespace wordgaze::policy
