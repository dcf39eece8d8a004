#include <algorithm>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/minigrid_stages.hpp"
#include "wordgaze/babyai/wording.hpp"

// MiniGrid's levels whose episode ends on the goal square. (docs/simulator.md, Levels)
namespace wordgaze::babyai::generators {

using grid::at;
using grid::Color;
using grid::Grid;
using grid::kNothing;
using grid::kWall;
using grid::ObjectId;
using grid::Position;
using grid::Type;

namespace {

void ask_for_goal(Layout& layout) { ask(layout, "get to the green goal square"); }

ObjectId add_lava(Layout& layout) { return layout.world.add(Type::lava, Color::red); }

void dist_shift(Layout& layout, int row) {
  constexpr int kWidth = 9, kHeight = 7;
  empty_grid(layout, kWidth, kHeight);
  put_new(layout, Type::goal, Color::green, at(kWidth - 2, 1));
  const ObjectId lava = add_lava(layout);
  for (int x = 3; x < kWidth - 3; ++x) {
    layout.world.put(lava, at(x, 1));
    layout.world.put(lava, at(x, row));
  }
  agent_in_corner(layout);
  ask_for_goal(layout);
}

// Rivers of lava or wall across the room, each with one crossing, so that a path is left.
void crossing(Layout& layout, ObjectId what) {
  struct River {
    bool vertical;
    int at;
  };
  Grid& grid = layout.world.grid;
  const int width = grid.width(), height = grid.height();
  agent_in_corner(layout);
  goal_in_corner(layout);

  constexpr int kMax = kMaxGridSide;
  std::array<River, kMax> rivers;
  int count = 0;
  for (int i = 2; i < height - 2; i += 2) rivers[count++] = {true, i};
  for (int j = 2; j < width - 2; j += 2) rivers[count++] = {false, j};
  layout.rng.shuffle(std::span(rivers).first(count));

  // Where the rivers run, between the borders.
  std::array<int, kMax + 2> columns, rows;
  int vertical = 1, horizontal = 1;
  columns[0] = rows[0] = 0;
  const int steps = layout.parameters<Crossings>().rivers;
  for (int k = 0; k < steps; ++k) {
    if (rivers[k].vertical) {
      columns[vertical++] = rivers[k].at;
    } else {
      rows[horizontal++] = rivers[k].at;
    }
  }
  std::sort(columns.begin(), columns.begin() + vertical);
  std::sort(rows.begin(), rows.begin() + horizontal);
  columns[vertical] = height - 1;
  rows[horizontal] = width - 1;
  for (int k = 1; k < horizontal; ++k) {
    for (int x = 1; x < width - 1; ++x) grid[at(x, rows[k])] = what;
  }
  for (int k = 1; k < vertical; ++k) {
    for (int y = 1; y < height - 1; ++y) grid[at(columns[k], y)] = what;
  }

  // The path crosses a vertical river with each step right and a horizontal one with each step
  // down.
  std::array<bool, kMax> path_goes_right;
  for (int k = 0; k < steps; ++k) path_goes_right[k] = k < vertical - 1;
  layout.rng.shuffle(std::span(path_goes_right).first(steps));
  int i = 0, j = 0;
  for (int k = 0; k < steps; ++k) {
    if (path_goes_right[k]) {
      grid[at(columns[i + 1], layout.between(rows[j] + 1, rows[j + 1]))] = kNothing;
      ++i;
    } else {
      grid[at(layout.between(columns[i] + 1, columns[i + 1]), rows[j + 1])] = kNothing;
      ++j;
    }
  }
}

}  // namespace

void empty_room(Layout& layout) {
  empty_grid(layout);
  goal_in_corner(layout);
  agent_in_corner(layout);
  ask_for_goal(layout);
}

void empty_room_random_start(Layout& layout) {
  empty_grid(layout);
  goal_in_corner(layout);
  layout.Builder::place_agent();
  ask_for_goal(layout);
}

void dist_shift_near(Layout& layout) { dist_shift(layout, 2); }
void dist_shift_far(Layout& layout) { dist_shift(layout, 5); }

void door_key(Layout& layout) {
  empty_grid(layout);
  goal_in_corner(layout);
  grid::World& world = layout.world;
  const int height = world.grid.height();
  const int x = layout.between(2, world.grid.width() - 2);
  world.grid.wall_column(at(x, 0), height);
  layout.Builder::place_agent({}, x, height);
  const int y = layout.between(1, height - 2);
  world.put(world.add(Type::door, Color::yellow, grid::DoorState::locked), at(x, y));
  layout.place(world.add(Type::key, Color::yellow), {}, x, height);
  ask(layout, "use the key to open the door and then get to the goal");
}

void lava_gap(Layout& layout) {
  empty_grid(layout);
  agent_in_corner(layout);
  goal_in_corner(layout);
  grid::World& world = layout.world;
  const int height = world.grid.height();
  const int x = layout.between(2, world.grid.width() - 2);
  const int gap = layout.between(1, height - 1);
  const ObjectId lava = add_lava(layout);
  for (int y = 1; y < height - 1; ++y) world.put(lava, at(x, y));
  world.grid[at(x, gap)] = kNothing;
  ask(layout, "avoid the lava and get to the green goal square");
}

void lava_crossing(Layout& layout) {
  empty_grid(layout);
  crossing(layout, add_lava(layout));
  ask(layout, "avoid the lava and get to the green goal square");
}

void simple_crossing(Layout& layout) {
  empty_grid(layout);
  crossing(layout, kWall);
  ask(layout, "find the opening and get to the green goal square");
}

void four_rooms(Layout& layout) {
  empty_grid(layout);
  Grid& grid = layout.world.grid;
  const int half = grid.width() / 2;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int left = i * half, top = j * half;
      if (i == 0) {
        grid.wall_column(at(half, top), half);
        grid[at(half, layout.between(top + 1, top + half))] = kNothing;
      }
      if (j == 0) {
        grid.wall_row(at(left, half), half);
        grid[at(layout.between(left + 1, left + half), half)] = kNothing;
      }
    }
  }
  layout.Builder::place_agent();
  layout.place(layout.world.add(Type::goal, Color::green));
  ask(layout, "reach the goal");
}

namespace {

void dynamic_obstacles(Layout& layout, bool random_start) {
  constexpr int kTries = 100;
  empty_grid(layout);
  goal_in_corner(layout);
  if (random_start) {
    layout.Builder::place_agent();
  } else {
    agent_in_corner(layout);
  }
  const int size = layout.level.room_size;
  const int wanted = layout.parameters<Obstacles>().count;
  const int count = 2 * wanted <= size + 2 ? wanted : size / 2;
  // They are the last objects of the table.
  layout.task.target.object = static_cast<ObjectId>(layout.world.objects.size());
  for (int k = 0; k < count; ++k) {
    layout.place(layout.world.add(Type::ball, Color::blue), {}, size, size, kTries);
  }
  ask_for_goal(layout);
}

}  // namespace

void dynamic_obstacles(Layout& layout) { dynamic_obstacles(layout, false); }
void dynamic_obstacles_random_start(Layout& layout) { dynamic_obstacles(layout, true); }

void locked_room(Layout& layout) {
  struct Room {
    Position corner;
    Position door;
    ObjectId door_id;
  };
  empty_grid(layout);
  grid::World& world = layout.world;
  const int width = world.grid.width(), height = world.grid.height();
  const int left = width / 2 - 2, right = width / 2 + 2;  // walls of the hallway
  const int room_height = height / 3;
  world.grid.wall_column(at(left, 0), height);
  world.grid.wall_column(at(right, 0), height);
  std::array<Room, 6> rooms;
  for (int k = 0; k < 3; ++k) {
    const int top = k * room_height;
    world.grid.wall_row(at(0, top), left);
    world.grid.wall_row(at(right, top), width - right);
    rooms[2 * k] = {at(0, top), at(left, top + 3), kNothing};
    rooms[2 * k + 1] = {at(right, top), at(right, top + 3), kNothing};
  }
  const auto random_cell = [&](const Room& room) {
    const int x = layout.between(room.corner.x + 1, room.corner.x + left);
    return at(x, layout.between(room.corner.y + 1, room.corner.y + room_height));
  };

  const int locked = layout.rng.below(6);
  put_new(layout, Type::goal, Color::green, random_cell(rooms[locked]));
  auto colors = grid::kColorsToDraw;
  for (int k = 0; k < 6; ++k) {
    // One of the colors left.
    layout.pick_to_front(std::span(colors).subspan(k), 1);
    rooms[k].door_id = put_door(layout, colors[k], rooms[k].door);
    if (k == locked) world.set_door(rooms[k].door_id, grid::DoorState::locked);
  }
  int of_key = 0;
  do {
    of_key = layout.rng.below(6);
  } while (of_key == locked);
  put_new(layout, Type::key, colors[locked], random_cell(rooms[of_key]));
  layout.Builder::place_agent(at(left, 0), right - left, height);
  Sentence& mission = layout.task.sentence;
  mission = sentence_of("get the");
  mission.append(word_of(colors[locked]), 0);
  say(mission, "key from the");
  mission.append(word_of(colors[of_key]), 0);
  say(mission, "room, unlock the");
  mission.append(word_of(colors[locked]), 0);
  say(mission, "door and go to the goal");
}

namespace {

// A chain of rooms, each grown from a door of the one before.
class RoomChain {
 public:
  struct Room {
    Position corner;
    int width = 0, height = 0;
    Position entry;
  };
  static constexpr int kMaxRooms = MultiRoom::kMaxRooms;
  static constexpr int kSide = MultiRoom::kGridSide;

  explicit RoomChain(Layout& layout)
      : layout_(layout), max_size_(layout.parameters<MultiRoom>().largest) {}

  void grow(int rooms) {
    count_ = 0;
    const int x = layout_.between(0, kSide - 2);
    grow(rooms, 2, at(x, layout_.between(0, kSide - 2)));
  }
  std::span<const Room> rooms() const { return std::span(rooms_).first(count_); }

 private:
  // Adds a room entered by a door in one of its walls (0 right, 1 below, 2 left, 3 above), and up
  // to `left` - 1 more behind it. False when this room has no space.
  bool grow(int left, int wall, Position entry) {
    constexpr int kTries = 8;
    const int width = layout_.between(4, max_size_ + 1);
    const int height = layout_.between(4, max_size_ + 1);
    Position corner = entry;
    if (count_ > 0) {
      switch (wall) {
        case 0:
          corner = at(entry.x - width + 1, layout_.between(entry.y - height + 2, entry.y));
          break;
        case 1:
          corner = at(layout_.between(entry.x - width + 2, entry.x), entry.y - height + 1);
          break;
        case 2:
          corner = at(entry.x, layout_.between(entry.y - height + 2, entry.y));
          break;
        case 3:
          corner = at(layout_.between(entry.x - width + 2, entry.x), entry.y);
          break;
      }
    }
    if (!fits(corner, width, height)) return false;
    rooms_[count_++] = {corner, width, height, entry};
    if (left == 1) return true;
    for (int tries = 0; tries < kTries; ++tries) {
      int exit = layout_.rng.below(3);  // of the other walls
      if (exit >= wall) ++exit;
      Position door = corner;
      switch (exit) {
        case 0:
          door = corner + at(width - 1, layout_.between(1, height - 1));
          break;
        case 1:
          door = corner + at(layout_.between(1, width - 1), height - 1);
          break;
        case 2:
          door = corner + at(0, layout_.between(1, height - 1));
          break;
        case 3:
          door = corner + at(layout_.between(1, width - 1), 0);
          break;
      }
      if (grow(left - 1, (exit + 2) % 4, door)) break;
    }
    return true;
  }

  bool fits(Position corner, int width, int height) const {
    // The reference wants one row more than columns.
    if (corner.x < 0 || corner.y < 0 || corner.x + width > kSide || corner.y + height >= kSide) {
      return false;
    }
    for (int k = 0; k + 1 < count_; ++k) {  // it may touch the room that it grows from
      const Room& r = rooms_[k];
      const bool apart = corner.x + width < r.corner.x || r.corner.x + r.width <= corner.x ||
                         corner.y + height < r.corner.y || r.corner.y + r.height <= corner.y;
      if (!apart) return false;
    }
    return true;
  }

  Layout& layout_;
  int max_size_;
  std::array<Room, kMaxRooms> rooms_;
  int count_ = 0;
};

}  // namespace

void multi_room(Layout& layout) {
  const int wanted = layout.parameters<MultiRoom>().rooms;
  RoomChain chain(layout);
  while (static_cast<int>(chain.rooms().size()) < wanted) chain.grow(wanted);

  layout.world.clear(RoomChain::kSide, RoomChain::kSide);
  std::optional<Color> previous;
  for (const RoomChain::Room& room : chain.rooms()) {
    layout.world.grid.wall_rectangle(room.corner, room.width, room.height);
    if (&room == chain.rooms().data()) continue;
    std::array<Color, 6> colors;
    const auto end = std::copy_if(grid::kColorsToDraw.begin(), grid::kColorsToDraw.end(),
                                  colors.begin(), [&](Color c) { return c != previous; });
    previous = layout.pick(std::span<const Color>(colors.begin(), end));
    put_door(layout, *previous, room.entry);
  }
  const RoomChain::Room &first = chain.rooms().front(), &last = chain.rooms().back();
  layout.Builder::place_agent(first.corner, first.width, first.height);
  layout.place(layout.world.add(Type::goal, Color::green), last.corner, last.width, last.height);
  ask(layout, "traverse the rooms to get to the goal");
}

}  // namespace wordgaze::babyai::generators
