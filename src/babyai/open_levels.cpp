#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/stages.hpp"

namespace wordgaze::babyai::generators {

using grid::Color;
using grid::Direction;
using grid::ObjectId;
using grid::ObjectRange;
using grid::Type;

namespace {

constexpr std::array kSides{Direction::right, Direction::down, Direction::left, Direction::up};

// A door on each side of the middle room, unlocked.
ObjectRange four_doors(Layout& layout) {
  const auto colors = draw_colors(layout, 4);
  const ObjectRange doors{static_cast<ObjectId>(layout.world.objects.size()), 4};
  for (int k = 0; k < 4; ++k) layout.add_door(Layout::kMiddle, kSides[k], colors[k], false);
  return doors;
}

void ask_by_color(Layout& layout, ObjectRange doors) {
  layout.place_agent(Layout::kMiddle);
  layout.ask(Verb::open, layout.describe(doors[0]));
}

void ask_by_location(Layout& layout) {
  constexpr std::array kLocations{Location::left, Location::right, Location::front,
                                  Location::behind};
  const Description door{.type = Type::door, .location = layout.pick(kLocations)};
  layout.place_agent(Layout::kMiddle);
  layout.ask(Verb::open, door);
}

void ask_in_order(Layout& layout, ObjectId first, Order order, ObjectId second,
                  bool second_strict) {
  const Clause a{
      .verb = Verb::open, .object = layout.describe(first), .strict = layout.level.strict};
  const Clause b{.verb = Verb::open, .object = layout.describe(second), .strict = second_strict};
  layout.task.instruction = ordered(single(a), order, single(b));
}

void two_doors(Layout& layout, Color left, Color right) {
  const ObjectId first = layout.add_door(Layout::kMiddle, Direction::left, left, false);
  const ObjectId second = layout.add_door(Layout::kMiddle, Direction::right, right, false);
  layout.place_agent(Layout::kMiddle);
  ask_in_order(layout, first, Order::before, second, false);
}

}  // namespace

void open(Layout& layout) {
  layout.place_agent();
  layout.connect_all();
  layout.scatter_objects();
  layout.require_reachable();
  // Room by room: each door is listed twice, once for either room.
  std::array<ObjectId, 4 * Layout::kMaxRooms> doors;
  std::size_t count = 0;
  for (int i = 0; i < layout.columns(); ++i) {
    for (int j = 0; j < layout.rows(); ++j) {
      for (Direction side : kSides) {
        const ObjectId door = layout.door({i, j}, side);
        if (door != grid::kNothing) doors[count++] = door;
      }
    }
  }
  layout.ask(Verb::open,
             layout.describe(layout.pick(std::span<const ObjectId>(doors).first(count))));
}

void open_red_door(Layout& layout) {
  const ObjectId door = layout.add_door({}, Direction::right, Color::red, false);
  layout.place_agent(grid::RoomIndex{});
  layout.ask(Verb::open, layout.describe(door));
}

void open_door(Layout& layout) {
  const ObjectRange doors = four_doors(layout);
  const bool by_color = layout.coin();
  if (by_color) {
    ask_by_color(layout, doors);
  } else {
    ask_by_location(layout);
  }
}

void open_door_by_color(Layout& layout) { ask_by_color(layout, four_doors(layout)); }

void open_door_by_location(Layout& layout) {
  four_doors(layout);
  ask_by_location(layout);
}

void open_two_doors(Layout& layout) {
  const auto colors = draw_colors(layout, 2);
  two_doors(layout, colors[0], colors[1]);
}

void open_red_then_blue_door(Layout& layout) {
  draw_colors(layout, 2);  // drawn by the reference, then overruled
  two_doors(layout, Color::red, Color::blue);
}

void open_doors_in_order(Layout& layout) {
  const int count = layout.parameters<Doors>().count;
  const auto colors = draw_colors(layout, count);
  std::array<ObjectId, 6> doors;
  for (int k = 0; k < count; ++k) doors[k] = layout.add_door(Layout::kMiddle, {}, colors[k], false);
  layout.place_agent(Layout::kMiddle);
  layout.pick_to_front(std::span(doors).first(count), 2);
  switch (layout.rng.below(3)) {
    case 0:
      layout.ask(Verb::open, layout.describe(doors[0]));
      break;
    case 1:
      ask_in_order(layout, doors[0], Order::before, doors[1], layout.level.strict);
      break;
    case 2:
      ask_in_order(layout, doors[0], Order::after, doors[1], layout.level.strict);
      break;
  }
}

void act_on_object_or_door(Layout& layout) {
  ObjectRange targets = layout.scatter_objects(Layout::kMiddle);
  targets.count += add_doors(layout, 4, false).count;
  layout.place_agent(Layout::kMiddle);
  const ObjectId target = layout.pick_object(targets);
  const Description description = layout.describe(target);
  const bool is_door = description.type == Type::door;
  const bool go = layout.coin();
  layout.ask(go ? Verb::go_to : is_door ? Verb::open : Verb::pickup, description);
}

}  // namespace wordgaze::babyai::generators
