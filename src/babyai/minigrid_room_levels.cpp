#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/minigrid_stages.hpp"
#include "wordgaze/babyai/stages.hpp"

// MiniGrid's levels built of rooms. (docs/simulator.md, Levels)
namespace wordgaze::babyai::generators {

using grid::Color;
using grid::Direction;
using grid::ObjectId;
using grid::RoomIndex;
using grid::Type;

namespace {

void ask_to_pick_up(Layout& layout, ObjectId target) {
  layout.task.target.object = target;
  ask(layout, "pick up the");
  append_name(layout.task.sentence, layout.world.object(target));
}

constexpr Color kTargetColor = grid::kColorsToDraw[0];
constexpr Color kBlockingColor = grid::kColorsToDraw[1];
constexpr Color kBoxColor = grid::kColorsToDraw[2];

// The key of a color, in a box or bare, in a room.
void hide_key(Layout& layout, const ObstructedDoor& by, RoomIndex room, Color color) {
  ObjectId hidden = layout.world.add(Type::key, color);
  if (by.key_in_box) {
    const ObjectId box = layout.world.add(Type::box, kBoxColor);
    layout.world.objects[box].contents = hidden;
    hidden = box;
  }
  layout.place_in_room(hidden, room);
}

void add_locked_door(Layout& layout, const ObstructedDoor& by, RoomIndex room, Direction side,
                     Color color) {
  const ObjectId door = layout.add_door(room, side, color, true);
  if (by.blocked) block(layout, door, side, kBlockingColor);
}

}  // namespace

void open_locked_door(Layout& layout) {
  const ObjectId door = layout.add_door({0, 0}, Direction::right, {}, true);
  add_key(layout, {0, 0}, door);
  layout.place_agent(RoomIndex{0, 0});
  layout.task.target.object = door;
  ask(layout, "open the door");
}

void box_behind_door(Layout& layout) {
  const auto [box, door] = box_behind_locked_door(layout);
  add_key(layout, {0, 0}, door);
  layout.place_agent(RoomIndex{0, 0});
  ask_to_pick_up(layout, box);
}

void blocked_box_behind_door(Layout& layout) {
  const auto [box, door] = box_behind_locked_door(layout);
  block(layout, door, Direction::right, layout.color());
  add_key(layout, {0, 0}, door);
  layout.place_agent(RoomIndex{0, 0});
  ask_to_pick_up(layout, box);
}

void ball_off_corridor(Layout& layout) { ask_to_pick_up(layout, object_off_corridor(layout)); }

void obstructed_door(Layout& layout) {
  const auto colors = draw_colors(layout, 6);
  const auto& obstruction = layout.parameters<ObstructedDoor>();
  add_locked_door(layout, obstruction, {0, 0}, Direction::right, colors[0]);
  hide_key(layout, obstruction, {0, 0}, colors[0]);
  const ObjectId target = layout.add_object({1, 0}, Type::ball, kTargetColor);
  layout.place_agent(RoomIndex{0, 0});
  ask_to_pick_up(layout, target);
}

void obstructed_maze(Layout& layout) {
  // The rooms at the sides of the middle one, and the corners between them.
  constexpr std::array<RoomIndex, 4> kSides{{{2, 1}, {1, 2}, {0, 1}, {1, 0}}};
  constexpr std::array<RoomIndex, 4> kCorners{{{2, 0}, {2, 2}, {0, 2}, {0, 0}}};
  const Maze& maze = layout.parameters<Maze>();
  const auto colors = draw_colors(layout, 6);
  for (int i = 0; i < maze.quarters; ++i) {
    const auto outward = static_cast<Direction>(i);
    layout.add_door(Layout::kMiddle, outward, colors[i], false);
    // From each side room two locked doors lead to the corners.
    const std::array color_of{colors[(i + 5) % 6], colors[(i + 1) % 6]};
    const std::array side_of{turned(outward, -1), turned(outward, 1)};
    for (int k = 0; k < 2; ++k) {
      add_locked_door(layout, maze.doors, kSides[i], side_of[k], color_of[k]);
      if (!maze.keys_last) hide_key(layout, maze.doors, kSides[i], color_of[k]);
    }
    if (!maze.keys_last) continue;
    for (Color color : color_of) hide_key(layout, maze.doors, kSides[i], color);
  }
  const RoomIndex corner = layout.pick(std::span(kCorners).first(maze.quarters));
  const ObjectId target = layout.add_object(corner, Type::ball, kTargetColor);
  layout.place_agent(RoomIndex{maze.agent_column, maze.agent_row});
  ask_to_pick_up(layout, target);
}

}  // namespace wordgaze::babyai::generators
