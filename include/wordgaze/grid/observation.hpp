#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace wordgaze::grid {

struct World;

inline constexpr int kViewSize = 7;
inline constexpr int kViewCells = kViewSize * kViewSize;
inline constexpr int kImageBytes = kViewCells * 3;

/// The agent's view, as gym's obs["image"]: [x][y][channel], channels type, color, door state. The
/// agent stands at x = 3, y = 6 and looks to y = 0.
using ImageView = std::span<std::uint8_t, kImageBytes>;

/// Which cells of the view are seen: bit x of row y.
using VisibleRows = std::array<std::uint8_t, kViewSize>;

/// Writes what the agent sees; cells that it does not see are (0, 0, 0).
void observe(const World& world, ImageView image);

/// Writes all cells of a world, as the reference's Grid.encode(): [x][y][channel], channels as
/// above. An empty cell is (1, 0, 0), and the agent is not among them.
void write_cells(const World& world, std::vector<std::uint8_t>& cells);

/// The cells of the view that the agent sees.
VisibleRows visible_cells(const World& world);

}  // namespace wordgaze::grid
