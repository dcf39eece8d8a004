#include "wordgaze/babyai/stages.hpp"

namespace wordgaze::babyai::generators {

using grid::Direction;
using grid::ObjectId;
using grid::ObjectRange;
using grid::RoomIndex;
using grid::Type;

std::array<grid::Color, 6> draw_colors(Layout& layout, int count) {
  auto colors = grid::kColorsToDraw;
  layout.pick_to_front(colors, count);
  return colors;
}

ObjectRange add_doors(Layout& layout, int count, std::optional<bool> locked) {
  const ObjectRange doors{static_cast<ObjectId>(layout.world.objects.size()), count};
  for (int k = 0; k < count; ++k) layout.add_door(Layout::kMiddle, {}, {}, locked);
  return doors;
}

LockedRoom lock_a_room(Layout& layout) {
  const RoomIndex room = layout.random_room();
  const ObjectId door = layout.add_door(room, {}, {}, true);
  const RoomIndex of_key = layout.random_room();
  add_key(layout, of_key, door);
  return {room, door};
}

void scatter_in_every_room(Layout& layout, int count) {
  for (int i = 0; i < layout.columns(); ++i) {
    for (int j = 0; j < layout.rows(); ++j) layout.scatter(RoomIndex{i, j}, count, false);
  }
}

void place_agent_outside(Layout& layout, RoomIndex room) {
  do {
    layout.place_agent();
  } while (layout.room_of(layout.world.agent) == room);
}

BoxBehindDoor box_behind_locked_door(Layout& layout) {
  const ObjectId box = layout.add_object({1, 0}, Type::box);
  return {box, layout.add_door({0, 0}, Direction::right, {}, true)};
}

void block(Layout& layout, ObjectId door, Direction side, grid::Color color) {
  const grid::Position before = layout.world.object(door).position - forward(side);
  layout.world.put(layout.world.add(Type::ball, color), before);
}

void add_key(Layout& layout, RoomIndex room, ObjectId door) {
  layout.add_object(room, Type::key, layout.world.object(door).color);
}

ObjectId object_off_corridor(Layout& layout) {
  for (int j = 1; j < layout.rows(); ++j) layout.remove_wall({1, j}, Direction::up);
  const RoomIndex room{2, layout.rng.below(layout.rows())};
  const ObjectId door = layout.add_door(room, Direction::left, {}, true);
  const ObjectId object = layout.add_object(room, Type::ball);
  add_key(layout, {0, layout.rng.below(layout.rows())}, door);
  layout.place_agent(RoomIndex{1, layout.rows() / 2});
  layout.connect_all();
  return object;
}

}  // namespace wordgaze::babyai::generators
