#include "wordgaze/bot/seen.hpp"

#include "wordgaze/grid/observation.hpp"

namespace wordgaze::bot {

using grid::kViewSize;
using grid::Position;

void Seen::look(const grid::World& world) {
  const grid::VisibleRows visible = grid::visible_cells(world);
  const Position ahead = forward(world.direction);
  const Position right = forward(turned(world.direction, 1));
  for (int y = 0; y < kViewSize; ++y) {
    for (int x = 0; x < kViewSize; ++x) {
      const int distance = kViewSize - 1 - y, aside = x - kViewSize / 2;
      const Position p = world.agent + grid::at(ahead.x * distance + right.x * aside,
                                                ahead.y * distance + right.y * aside);
      if ((visible[y] >> x & 1) != 0 && world.grid.contains(p)) cells_[index(p)] = 1;
    }
  }
}

}  // namespace wordgaze::bot
