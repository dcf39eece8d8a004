#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::grid {

/// Thrown by generators: this layout cannot be used, start over with the random stream where it is.
struct Rejected {};

/// Thrown where the reference's generator would never end.
struct GaveUp {};

/// Random draws and placements, in the order and number of MiniGrid's. (docs/simulator.md, Levels)
class Builder {
 public:
  static constexpr int kUnlimited = std::numeric_limits<int>::max();
  static constexpr int kPatience = 10'000'000;  ///< tries, where they are not limited

  Builder(World& w, core::Rng& r) : world(w), rng(r) {}

  World& world;
  core::Rng& rng;

  /// Uniform in [low, high).
  int between(int low, int high) { return low + rng.below(high - low); }
  bool coin() { return rng.below(2) == 0; }
  template <class T>
  const T& pick(std::span<const T> items) {
    if (items.empty()) throw std::out_of_range("pick: nothing to pick from");
    return items[rng.below(static_cast<int>(items.size()))];
  }
  template <class T, std::size_t n>
  const T& pick(const std::array<T, n>& items) {
    return pick(std::span<const T>(items));
  }
  Color color() { return pick(kColorsToDraw); }
  /// Moves `count` drawn items, without replacement, to the front, the first drawn first. The
  /// others keep their order.
  template <class Items>
  void pick_to_front(Items&& items, int count) {
    if (count > static_cast<int>(items.size())) throw std::out_of_range("pick_to_front: too many");
    for (int i = 0; i < count; ++i) {
      const int index = between(i, static_cast<int>(items.size()));
      const auto drawn = items[index];
      for (int k = index; k > i; --k) items[k] = items[k - 1];
      items[i] = drawn;
    }
  }

  /// Puts an object into a random empty cell of a rectangle, away from the agent and where
  /// `unfit(position)` is false. kNothing only looks for such a cell. Throws Rejected after
  /// `max_tries` + 1 cells; GaveUp where no number of them would do.
  template <class Unfit>
  Position place(ObjectId id, Position corner, int width, int height, Unfit unfit,
                 int max_tries = kUnlimited) {
    const int left = std::max<int>(corner.x, 0), top = std::max<int>(corner.y, 0);
    const int right = std::min(left + width, world.grid.width());
    const int bottom = std::min(top + height, world.grid.height());
    if (right <= left || bottom <= top) throw GaveUp{};
    for (int tries = 0; tries <= max_tries; ++tries) {
      if (tries == kPatience) throw GaveUp{};
      // Both are drawn even where x alone dooms the cell.
      const int x = between(left, right);
      const Position p = at(x, between(top, bottom));
      if (world.grid[p] != kNothing || p == world.agent || unfit(p)) continue;
      if (id != kNothing) world.put(id, p);
      return p;
    }
    throw Rejected{};
  }
  Position place(ObjectId id, Position corner, int width, int height, int max_tries = kUnlimited) {
    return place(
        id, corner, width, height, [](Position) { return false; }, max_tries);
  }
  /// Anywhere in the grid.
  Position place(ObjectId id) { return place(id, {}, world.grid.width(), world.grid.height()); }

  void place_agent(Position corner, int width, int height, int max_tries = kUnlimited);
  void place_agent() { place_agent({}, world.grid.width(), world.grid.height()); }
};

}  // namespace wordgaze::grid
