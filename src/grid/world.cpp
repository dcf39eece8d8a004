#include "wordgaze/grid/world.hpp"

#include <stdexcept>

namespace wordgaze::grid {

void World::clear(int width, int height) {
  grid.clear(width, height);
  objects.clear();
  objects.push_back({});
  objects.push_back({.type = Type::wall, .color = Color::grey});
  sight_blockers = only(kWall);
  agent = kNowhere;
  direction = Direction::right;
  carried = kNothing;
  step_count = 0;
  room_size = 0;
}

ObjectId World::add(Type type, Color color, DoorState state) {
  if (objects.size() == kMaxObjects) {
    throw std::length_error("a world holds at most 62 objects besides its walls");
  }
  const auto id = static_cast<ObjectId>(objects.size());
  objects.push_back({.type = type, .color = color, .state = state});
  if (blocks_sight(objects.back())) sight_blockers |= only(id);
  return id;
}

void World::put(ObjectId id, Position p) {
  grid[p] = id;
  if (id > kWall) objects[id].position = p;
}

void World::set_door(ObjectId id, DoorState state) {
  objects[id].state = state;
  if (state == DoorState::open) {
    sight_blockers &= ~only(id);
  } else {
    sight_blockers |= only(id);
  }
}

}  // namespace wordgaze::grid
