#include <algorithm>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/stages.hpp"

namespace wordgaze::babyai::generators {

using grid::Color;
using grid::Direction;
using grid::ObjectId;
using grid::RoomIndex;
using grid::Type;

void unlock(Layout& layout) {
  const LockedRoom locked = lock_a_room(layout);
  const Color color = layout.world.object(locked.door).color;
  const bool only_door_of_its_color = layout.coin();
  if (only_door_of_its_color) {
    std::array<Color, 5> others;
    std::remove_copy(grid::kColorsToDraw.begin(), grid::kColorsToDraw.end(), others.begin(), color);
    layout.connect_all(others);
  } else {
    layout.connect_all();
  }
  scatter_in_every_room(layout, 3);
  place_agent_outside(layout, locked.room);
  layout.require_reachable();
  layout.ask(Verb::open, layout.describe(locked.door));
}

void unlock_local(Layout& layout) {
  const ObjectId door = layout.add_door(Layout::kMiddle, {}, {}, true);
  add_key(layout, Layout::kMiddle, door);
  layout.scatter_objects(Layout::kMiddle);
  layout.place_agent(Layout::kMiddle);
  layout.ask(Verb::open, layout.describe_type(door));
}

void key_in_box(Layout& layout) {
  const ObjectId door = layout.add_door(Layout::kMiddle, {}, {}, true);
  const ObjectId box = layout.world.add(Type::box, layout.color());
  layout.world.objects[box].contents = layout.world.add(Type::key, layout.world.object(door).color);
  layout.place_in_room(box, Layout::kMiddle);
  layout.place_agent(Layout::kMiddle);
  layout.ask(Verb::open, layout.describe_type(door));
}

void unlock_and_pick_up(Layout& layout) {
  const auto [box, door] = box_behind_locked_door(layout);
  add_key(layout, {0, 0}, door);
  layout.scatter_objects();
  layout.place_agent(RoomIndex{0, 0});
  layout.ask(Verb::pickup, layout.describe(box));
}

void unblock_unlock_and_pick_up(Layout& layout) {
  const auto [box, door] = box_behind_locked_door(layout);
  block(layout, door, Direction::right, layout.color());
  add_key(layout, {0, 0}, door);
  layout.place_agent(RoomIndex{0, 0});
  layout.ask(Verb::pickup, layout.describe_type(box));
}

void unlock_to_unlock(Layout& layout) {
  const auto colors = draw_colors(layout, 2);
  layout.add_door({0, 0}, Direction::right, colors[0], true);
  layout.add_object({2, 0}, Type::key, colors[0]);
  layout.add_door({1, 0}, Direction::right, colors[1], true);
  layout.add_object({1, 0}, Type::key, colors[1]);
  const ObjectId ball = layout.add_object({0, 0}, Type::ball);
  layout.place_agent(RoomIndex{1, 0});
  layout.ask(Verb::pickup, layout.describe_type(ball));
}

}  // namespace wordgaze::babyai::generators
