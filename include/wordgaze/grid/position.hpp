#pragma once
#include <array>
#include <cstdint>
#include <cstdlib>

namespace wordgaze::grid {

/// A cell by column and row, (0, 0) at the top left; also a displacement.
struct Position {
  std::int16_t x = 0, y = 0;

  constexpr bool operator==(const Position&) const = default;
  constexpr Position operator+(Position o) const {
    return {static_cast<std::int16_t>(x + o.x), static_cast<std::int16_t>(y + o.y)};
  }
  constexpr Position operator-(Position o) const {
    return {static_cast<std::int16_t>(x - o.x), static_cast<std::int16_t>(y - o.y)};
  }
};

/// A position from ints, for the arithmetic of generators.
constexpr Position at(int x, int y) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
}

/// Where something stands that stands nowhere: carried, or not yet placed.
inline constexpr Position kNowhere{-1, -1};

/// Number of steps between two cells when nothing is in the way.
constexpr int manhattan(Position a, Position b) {
  const int dx = a.x - b.x, dy = a.y - b.y;
  return (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
}

/// Whether two cells are the same or touch, corners included.
constexpr bool is_near(Position a, Position b) {
  const int dx = a.x - b.x, dy = a.y - b.y;
  return dx >= -1 && dx <= 1 && dy >= -1 && dy <= 1;
}

enum class Direction : std::uint8_t { right, down, left, up };

inline constexpr std::array<Position, 4> kForward{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The step that goes one cell in a direction.
constexpr Position forward(Direction d) { return kForward[static_cast<int>(d)]; }
/// The direction after a number of quarter turns clockwise (negative: counterclockwise).
constexpr Direction turned(Direction d, int quarters) {
  return static_cast<Direction>((static_cast<int>(d) + quarters) & 3);
}

}  // namespace wordgaze::grid
