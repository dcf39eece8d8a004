#include "wordgaze/grid/world.hpp"

#include <stdexcept>

namespace wordgaze::grid {

void World::clear(int width, int height) {
  grid.clear(width, height);
  objects.clear();
  add(Type::empty, Color::red);
  add(Type::wall, Color::grey);
  agent = kNowhere;
  direction = Direction::right;
  carried = kNothing;
  carried_from = kNowhere;
  step_count = 0;
  room_size = 0;
}

ObjectId World::add(Type type, Color color, DoorState state) {
  if (objects.size() == kMaxObjects) {
    throw std::length_error("a world holds at most 62 objects besides its walls");
  }
  const auto id = static_cast<ObjectId>(objects.size());
  objects.push_back({.type = type, .color = color, .state = state});
  looks[id] = look_of(objects.back());
  return id;
}

void World::put(ObjectId id, Position p) {
  grid[p] = id;
  if (id > kWall) objects[id].position = p;
}

void World::set_door(ObjectId id, DoorState state) {
  objects[id].state = state;
  looks[id] = look_of(objects[id]);
}

void World::paint(ObjectId id, Color color) {
  objects[id].color = color;
  looks[id] = look_of(objects[id]);
}

}  // namespace wordgaze::grid
