#include "needs.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "wordgaze/babyai/generators.hpp"

namespace wordgaze::babyai {
namespace {

using namespace generators;

constexpr int kKinds = 18;                           // types times colors: so many are different
constexpr int kMostObjects = grid::kMaxObjects - 2;  // without "nothing" and the wall

struct Row {
  Generator generate;
  Needs needs;
};

constexpr auto kObjects = kind_of<Objects>();

// One room, with room for an agent and an object.
constexpr Needs kOneGrid{.most = 1, .smallest = 4};
constexpr Needs kOneRoom{.kind = kObjects, .most = 1, .smallest = 4};
constexpr Needs kMaze{.kind = kObjects, .smallest = 4, .least = 1, .connects = true};
// The middle room with a door on each side.
constexpr Needs kFourDoors{.columns = 3, .rows = 3, .smallest = 4, .doors = 4};

constexpr Needs with(Needs needs, auto change) {
  change(needs);
  return needs;
}
constexpr Needs at_least(int objects, int room, Needs needs) {
  needs.least = objects;
  needs.smallest = std::max(needs.smallest, room);
  return needs;
}
constexpr Needs besides(int others, Needs needs) {
  needs.others = others;
  return needs;
}
constexpr Needs from(int room, Needs needs) {
  needs.smallest = room;
  return needs;
}

constexpr Needs kTwoSides{
    .kind = kObjects, .columns = 2, .smallest = 4, .least = 1, .times = 2, .together = true};
constexpr Needs kFourDoorsAndObjects{
    .kind = kObjects, .columns = 3, .rows = 3, .smallest = 4, .together = true, .doors = 4};
constexpr Needs kLockedBox{.columns = 2, .smallest = 4, .others = 2, .doors = 1};
constexpr Needs kCorridor{
    .columns = 3, .most_columns = 3, .others = 2, .doors = 1, .connects = true};

constexpr std::array kRows{
    Row{one_room_task, {.kind = kind_of<OneRoomTask>(), .most = 1, .smallest = 5}},

    Row{go_to_red_ball, besides(1, kOneRoom)},
    Row{go_to_red_ball_among_grey, besides(1, kOneRoom)},
    Row{go_to_red_or_blue_ball, besides(1, kOneRoom)},
    Row{go_to_only_object, {.smallest = 4, .others = 1}},
    Row{go_to_local, at_least(1, 4, kOneRoom)},
    Row{go_to, kMaze},
    Row{go_to_with_open_doors, kMaze},
    Row{go_to_after_unlocking,
        {.fewest = 2, .smallest = 5, .others = 2, .per_room = 2, .connects = true}},
    Row{go_to_door, kFourDoors},
    Row{go_to_object_or_door, kFourDoorsAndObjects},

    Row{open, with(kMaze, [](Needs& n) { n.fewest = 2; })},
    Row{open_red_door, {.columns = 2, .doors = 1}},
    Row{open_door, kFourDoors},
    Row{open_door_by_color, kFourDoors},
    Row{open_door_by_location, kFourDoors},
    Row{open_two_doors, {.columns = 3, .rows = 2, .doors = 2}},
    Row{open_red_then_blue_door, {.columns = 3, .rows = 2, .doors = 2}},
    Row{open_doors_in_order,
        {.kind = kind_of<Doors>(), .columns = 3, .rows = 3, .smallest = 4, .doors = 4}},
    Row{act_on_object_or_door, kFourDoorsAndObjects},

    Row{unlock, {.fewest = 2, .smallest = 5, .others = 1, .per_room = 3, .connects = true}},
    Row{unlock_local,
        {.kind = kObjects,
         .columns = 2,
         .rows = 2,
         .smallest = 4,
         .together = true,
         .others = 1,
         .doors = 1}},
    Row{key_in_box, {.columns = 2, .rows = 2, .smallest = 4, .others = 2, .doors = 1}},
    Row{unlock_and_pick_up, with(kLockedBox, [](Needs& n) { n.kind = kObjects; })},
    Row{unblock_unlock_and_pick_up, besides(3, kLockedBox)},
    Row{unlock_to_unlock, {.columns = 3, .smallest = 4, .others = 3, .doors = 2}},

    Row{pick_up, kMaze},
    Row{unblock_and_pick_up, kMaze},
    Row{pick_up_among_distractors, at_least(1, 4, kOneRoom)},
    Row{pick_up_above, {.columns = 2, .rows = 2, .others = 1, .doors = 1, .connects = true}},
    Row{pick_up_only_ball, {.smallest = 4, .others = 1}},
    Row{find_object, {.columns = 2, .rows = 2, .square = true, .others = 1, .connects = true}},
    Row{key_corridor, kCorridor},

    Row{put_next_local, at_least(2, 5, kOneRoom)},
    Row{put_next, kTwoSides},
    Row{put_next_carrying, kTwoSides},
    Row{move_two_across, at_least(2, 5, kTwoSides)},

    Row{any_mission, with(besides(1, kMaze), [](Needs& n) { n.kind = kind_of<Missions>(); })},

    Row{planned, {.kind = kind_of<Plan>()}},

    Row{empty_room, kOneGrid},
    Row{empty_room_random_start, kOneGrid},
    Row{dist_shift_near, {.most = 1, .smallest = 9, .largest = 9}},
    Row{dist_shift_far, {.most = 1, .smallest = 9, .largest = 9}},
    Row{door_key, from(5, kOneGrid)},
    Row{lava_gap, from(5, kOneGrid)},
    Row{lava_crossing, {.kind = kind_of<Crossings>(), .most = 1, .smallest = 5}},
    Row{simple_crossing, {.kind = kind_of<Crossings>(), .most = 1, .smallest = 5}},
    Row{four_rooms, from(5, kOneGrid)},
    Row{dynamic_obstacles, {.kind = kind_of<Obstacles>(), .most = 1, .smallest = 5}},
    Row{dynamic_obstacles_random_start, {.kind = kind_of<Obstacles>(), .most = 1, .smallest = 5}},
    Row{locked_room, from(13, kOneGrid)},
    Row{multi_room,
        {.kind = kind_of<MultiRoom>(),
         .most = 1,
         .smallest = MultiRoom::kGridSide,
         .largest = MultiRoom::kGridSide}},

    Row{fetch, at_least(1, 4, kOneRoom)},
    Row{door_of_color, from(5, kOneGrid)},
    Row{object_of_color, at_least(1, 4, kOneRoom)},
    Row{put_near, with(at_least(2, 6, kOneRoom), [](Needs& n) { n.spacing = 9; })},
    Row{playground, from(9, kOneGrid)},
    Row{red_then_blue_door, {.most = 1, .smallest = 4, .largest = kMaxGridSide / 2}},
    Row{memory, from(7, kOneGrid)},
    Row{memory_random_length, from(7, kOneGrid)},

    Row{open_locked_door, {.columns = 2, .smallest = 4, .others = 1, .doors = 1}},
    Row{box_behind_door, kLockedBox},
    Row{blocked_box_behind_door, besides(3, kLockedBox)},
    Row{ball_off_corridor, kCorridor},
    Row{obstructed_door,
        {.kind = kind_of<ObstructedDoor>(), .columns = 2, .smallest = 5, .others = 4, .doors = 1}},
    Row{obstructed_maze,
        {.kind = kind_of<Maze>(),
         .columns = 3,
         .rows = 3,
         .smallest = 5,
         .others = 25,
         .doors = 12}},
};

// Walls between two rooms.
int inner_walls(const LevelSpec& level) {
  return (level.columns - 1) * level.rows + level.columns * (level.rows - 1);
}

// How many objects a room may hold. In a fuller one hardly a layout lets the agent reach every
// object, or none does: itself shuts out three cells, its own and two beside it, and of several
// rooms the doors must stay free.
int room_for(const LevelSpec& level, const Needs& needs) {
  const int cells = (level.room_size - 2) * (level.room_size - 2);
  if (level.columns * level.rows == 1 || !needs.connects) {
    return std::max(std::min(cells / 2, cells - 3), 0);
  }
  const auto* missions = std::get_if<Missions>(&level.parameters);
  return missions != nullptr && missions->unblocking ? cells / 3 : cells / 4;
}

bool all_different(const LevelSpec& level) {
  const auto* objects = std::get_if<Objects>(&level.parameters);
  return std::holds_alternative<OneRoomTask>(level.parameters) ||
         (objects != nullptr && objects->unique);
}

}  // namespace

Needs needs_of(Generator generate) {
  const auto* row = std::find_if(kRows.begin(), kRows.end(),
                                 [&](const Row& r) { return r.generate == generate; });
  return row != kRows.end() ? row->needs : Needs{.kind = kAnyKind};
}

int objects_left(const LevelSpec& level) {
  const Needs needs = needs_of(level.generate);
  const int doors = needs.connects ? inner_walls(level) : needs.doors;
  return kMostObjects - doors - needs.others - needs.per_room * level.columns * level.rows;
}

ObjectLimits object_limits(const LevelSpec& level) {
  const Needs needs = needs_of(level.generate);
  const int rooms = level.columns * level.rows;
  const int held = (needs.together ? 1 : rooms) * room_for(level, needs);
  const int free_cells = (level.room_size - 2) * (level.room_size - 2);
  const auto* task = std::get_if<OneRoomTask>(&level.parameters);

  int high =
      std::min(objects_left(level) / needs.times, needs.connects ? held : held - needs.others);
  if (needs.spacing > 0) high = std::min(high, (free_cells - 1) / needs.spacing + 1);
  if (all_different(level)) high = std::min(high, (kKinds - needs.others) / needs.times);
  return {task != nullptr ? task->clauses : needs.least, high};
}

}  // namespace wordgaze::babyai
