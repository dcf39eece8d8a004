#include "wordgaze/babyai/progress.hpp"

namespace wordgaze::babyai {

std::vector<grid::Position> target_cells(const grid::World& world, const Progress& progress) {
  const auto enabled = progress.enabled();
  const auto is_target = [&](const grid::Object& object) {
    if (!grid::is_object(object.type)) return false;
    for (std::size_t i = 0; i < enabled.size(); ++i) {
      if (enabled[i] && fits(progress.object(i), object.type, object.color)) return true;
    }
    return false;
  };
  const bool holds_target = is_target(world.object(world.carried));
  std::vector<grid::Position> cells;
  for (int x = 0; x < world.grid.width(); ++x) {
    for (int y = 0; y < world.grid.height(); ++y) {
      const grid::Position p = grid::at(x, y);
      if (is_target(world.object_at(p)) || (p == world.agent && holds_target)) cells.push_back(p);
    }
  }
  return cells;
}

}  // namespace wordgaze::babyai
