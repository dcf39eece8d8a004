#include <algorithm>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/minigrid_stages.hpp"
#include "wordgaze/babyai/wording.hpp"

// MiniGrid's levels about objects in one undivided grid. (docs/simulator.md, Levels)
namespace wordgaze::babyai::generators {

using grid::at;
using grid::Color;
using grid::Direction;
using grid::kWall;
using grid::ObjectId;
using grid::ObjectRange;
using grid::Position;
using grid::Type;

namespace {

constexpr std::array kTypes{Type::key, Type::ball, Type::box};

bool has_kind(const Layout& layout, ObjectRange objects, Type type, Color color) {
  for (int k = 0; k < objects.size(); ++k) {
    if (layout.describe(objects[k]) == Description{.type = type, .color = color}) return true;
  }
  return false;
}

// Objects in random cells that are not `unfit(position, earlier objects)`.
template <class Unfit>
ObjectRange scatter(Layout& layout, Unfit unfit) {
  const Objects& wanted = layout.parameters<Objects>();
  grid::World& world = layout.world;
  ObjectRange objects{static_cast<ObjectId>(world.objects.size()), 0};
  while (objects.count < wanted.count) {
    const Type type = layout.pick(kTypes);
    const Color color = layout.color();
    if (wanted.unique && has_kind(layout, objects, type, color)) continue;
    layout.place(world.add(type, color), {}, world.grid.width(), world.grid.height(),
                 [&](Position p) { return unfit(p, objects); });
    ++objects.count;
  }
  return objects;
}

}  // namespace

void fetch(Layout& layout) {
  constexpr std::array kFetched{Type::key, Type::ball};
  constexpr std::array<std::string_view, 5> kPhrases{"get a", "go get a", "fetch a", "go fetch a",
                                                     "you must fetch a"};
  empty_grid(layout);
  const ObjectRange objects{static_cast<ObjectId>(layout.world.objects.size()),
                            layout.parameters<Objects>().count};
  for (int k = 0; k < objects.size(); ++k) {
    const Type type = layout.pick(kFetched);
    layout.place(layout.world.add(type, layout.color()));
  }
  layout.Builder::place_agent();
  const ObjectId target = layout.pick_object(objects);
  layout.task.target.object = target;
  ask(layout, layout.pick(kPhrases));
  append_name(layout.task.sentence, layout.world.object(target));
}

void door_of_color(Layout& layout) {
  layout.world.clear(layout.level.room_size, layout.level.room_size);
  const int width = layout.between(5, layout.world.grid.width() + 1);
  const int height = layout.between(5, layout.world.grid.height() + 1);
  layout.world.grid.wall_rectangle({}, width, height);
  std::array<Position, 4> places;
  places[0] = at(layout.between(2, width - 2), 0);
  places[1] = at(layout.between(2, width - 2), height - 1);
  places[2] = at(0, layout.between(2, height - 2));
  places[3] = at(width - 1, layout.between(2, height - 2));
  std::array<Color, 4> colors;
  for (auto next = colors.begin(); next != colors.end();) {
    *next = layout.color();
    if (std::find(colors.begin(), next, *next) == next) ++next;
  }
  for (int k = 0; k < 4; ++k) put_door(layout, colors[k], places[k]);
  layout.Builder::place_agent({}, width, height);
  const int target = layout.rng.below(4);
  layout.task.target.place = places[target];
  ask(layout, "go to the");
  layout.task.sentence.append(word_of(colors[target]), 0);
  say(layout.task.sentence, "door");
}

void object_of_color(Layout& layout) {
  empty_grid(layout);
  const ObjectRange objects = scatter(layout, [](Position, ObjectRange) { return false; });
  layout.Builder::place_agent();
  const grid::Object& target = layout.world.object(layout.pick_object(objects));
  layout.task.target.place = target.position;
  ask(layout, "go to the");
  append_name(layout.task.sentence, target);
}

void put_near(Layout& layout) {
  empty_grid(layout);
  const ObjectRange objects = scatter(layout, [&](Position p, ObjectRange earlier) {
    for (int k = 0; k < earlier.size(); ++k) {
      if (is_near(p, layout.world.object(earlier[k]).position)) return true;
    }
    return false;
  });
  layout.Builder::place_agent();
  const ObjectId moved = layout.pick_object(objects);
  ObjectId near = moved;
  while (near == moved) near = layout.pick_object(objects);
  layout.task.target = {.object = moved, .place = layout.world.object(near).position};
  ask(layout, "put the");
  append_name(layout.task.sentence, layout.world.object(moved));
  say(layout.task.sentence, "near the");
  append_name(layout.task.sentence, layout.world.object(near));
}

void playground(Layout& layout) {
  constexpr int kObjects = 12;
  empty_grid(layout);
  const int third = layout.world.grid.width() / 3;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int left = i * third, top = j * third;
      const int right = left + third, bottom = top + third;
      if (i < 2) {
        layout.world.grid.wall_column(at(right, top), third);
        const Position door = at(right, layout.between(top + 1, bottom - 1));
        put_door(layout, layout.color(), door);
      }
      if (j < 2) {
        layout.world.grid.wall_row(at(left, bottom), third);
        const Position door = at(layout.between(left + 1, right - 1), bottom);
        put_door(layout, layout.color(), door);
      }
    }
  }
  layout.Builder::place_agent();
  for (int k = 0; k < kObjects; ++k) {
    const Type type = layout.pick(kTypes);
    layout.place(layout.world.add(type, layout.color()));
  }
  layout.task.sentence = {};
}

void red_then_blue_door(Layout& layout) {
  const int size = layout.level.room_size, half = size / 2;
  empty_grid(layout, 2 * size, size);
  layout.world.grid.wall_rectangle(at(half, 0), size, size);
  layout.Builder::place_agent(at(half, 0), size, size);
  const int red = layout.between(1, size - 1);
  layout.task.target.object = put_door(layout, Color::red, at(half, red));
  const int blue = layout.between(1, size - 1);
  layout.task.target.other = put_door(layout, Color::blue, at(half + size - 1, blue));
  ask(layout, "open the red door then the blue door");
}

namespace {

// A room with an object, a hallway, and behind it two objects: the way to the equal one is right.
void hallway(Layout& layout, bool random_length) {
  empty_grid(layout);
  grid::World& world = layout.world;
  grid::Grid& grid = world.grid;
  const int width = grid.width(), middle = grid.height() / 2;
  const int end = random_length ? layout.between(4, width - 2) : width - 3;
  for (int x = 1; x < 5; ++x) grid[at(x, middle - 2)] = grid[at(x, middle + 2)] = kWall;
  for (int x = 4; x < end; ++x) grid[at(x, middle - 1)] = grid[at(x, middle + 1)] = kWall;
  for (int y = 0; y < grid.height(); ++y) {
    if (y != middle) grid[at(end, y)] = kWall;
    grid[at(end + 2, y)] = kWall;
  }
  world.agent = at(layout.between(1, end + 1), middle);
  world.direction = Direction::right;

  constexpr std::array kShown{Type::key, Type::ball};
  const Type shown = layout.pick(kShown);
  put_new(layout, shown, Color::green, at(1, middle - 1));
  const Type above = layout.rng.below(2) == 0 ? Type::ball : Type::key;
  const Type below = above == Type::ball ? Type::key : Type::ball;
  put_new(layout, above, Color::green, at(end + 1, middle - 2));
  put_new(layout, below, Color::green, at(end + 1, middle + 2));
  const Position beside_upper = at(end + 1, middle - 1), beside_lower = at(end + 1, middle + 1);
  layout.task.target = shown == above ? Target{.place = beside_upper, .trap = beside_lower}
                                      : Target{.place = beside_lower, .trap = beside_upper};
  ask(layout, "go to the matching object at the end of the hallway");
}

}  // namespace

void memory(Layout& layout) { hallway(layout, false); }
void memory_random_length(Layout& layout) { hallway(layout, true); }

}  // namespace wordgaze::babyai::generators
