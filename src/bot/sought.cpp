#include "wordgaze/bot/sought.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace wordgaze::bot {

using grid::ObjectId;
using grid::ObjectSet;
using grid::Position;
using grid::World;

namespace {

void sort(std::vector<Standing>& all) {
  std::sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    return std::pair(a.place.x, a.place.y) < std::pair(b.place.x, b.place.y);
  });
}

// Calls `visit` with each object of a set but the walls.
template <class Visit>
void for_each_object(ObjectSet set, const Visit& visit) {
  for (set &= ~grid::only(grid::kWall); set != 0; set &= set - 1) {
    visit(static_cast<ObjectId>(std::countr_zero(set)));
  }
}

}  // namespace

std::vector<Standing> standing(const World& world, const babyai::Verifier& verifier,
                               const babyai::Meaning& meaning, ObjectSet meant,
                               const babyai::Description& description) {
  std::vector<Standing> all;
  for_each_object(meant, [&](ObjectId id) {
    if (const auto place = verifier.last_seen(world, id)) all.push_back({*place, id});
  });
  if ((meant & grid::only(grid::kWall)) != 0) {
    for (int x = 0; x < world.grid.width(); ++x) {
      for (int y = 0; y < world.grid.height(); ++y) {
        const Position p = grid::at(x, y);
        if (world.grid[p] != grid::kWall) continue;
        if (!lies(p, description.location, meaning.agent, meaning.direction)) continue;
        all.push_back({p, grid::kWall});
      }
    }
  }
  sort(all);
  return all;
}

std::vector<Standing> standing_keys(const World& world, grid::Color color) {
  std::vector<Standing> all;
  const ObjectSet found =
      babyai::matching_objects(world, {.type = grid::Type::key, .color = color});
  for_each_object(found, [&](ObjectId id) { all.push_back({world.object(id).position, id}); });
  sort(all);
  return all;
}

Sought::Sought(const std::vector<Standing>& all) {
  for (const Standing& one : all) objects.push_back(one.object);
  update_places(all);
}

void Sought::update_places(const std::vector<Standing>& all) {
  places.clear();
  for (const Standing& one : all) places.push_back(one.place);
}

}  // namespace wordgaze::bot
