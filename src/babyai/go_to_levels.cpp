#include <utility>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/stages.hpp"

namespace wordgaze::babyai::generators {
namespace {

// The red ball and the range of the distractors.
std::pair<grid::ObjectId, grid::ObjectRange> red_ball_and_others(Layout& layout) {
  layout.place_agent();
  const grid::ObjectId ball = layout.add_object({}, grid::Type::ball, grid::Color::red);
  return {ball, layout.scatter_objects()};
}

}  // namespace

void go_to_red_ball(Layout& layout) {
  const auto [ball, others] = red_ball_and_others(layout);
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(ball));
}

void go_to_red_ball_among_grey(Layout& layout) {
  const auto [ball, others] = red_ball_and_others(layout);
  for (int k = 0; k < others.size(); ++k) layout.world.paint(others[k], grid::Color::grey);
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(ball));
}

void go_to_red_or_blue_ball(Layout& layout) {
  layout.place_agent();
  const grid::ObjectRange others = layout.scatter_objects();
  for (int k = 0; k < others.size(); ++k) {
    const grid::Object& object = layout.world.object(others[k]);
    if (object.type == grid::Type::ball &&
        (object.color == grid::Color::red || object.color == grid::Color::blue)) {
      throw grid::Rejected{};
    }
  }
  constexpr std::array kColors{grid::Color::red, grid::Color::blue};
  const grid::ObjectId ball = layout.add_object({}, grid::Type::ball, layout.pick(kColors));
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(ball));
}

void go_to_only_object(Layout& layout) {
  layout.place_agent();
  const grid::ObjectRange object = layout.scatter(std::nullopt, 1, true);
  layout.ask(Verb::go_to, layout.describe(object[0]));
}

void go_to_local(Layout& layout) {
  layout.place_agent();
  const grid::ObjectRange objects = layout.scatter_objects();
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(layout.pick_object(objects)));
}

void go_to(Layout& layout) {
  layout.place_agent();
  layout.connect_all();
  const grid::ObjectRange objects = layout.scatter_objects();
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(layout.pick_object(objects)));
}

void go_to_with_open_doors(Layout& layout) {
  go_to(layout);
  for (std::size_t id = 0; id < layout.world.objects.size(); ++id) {
    if (layout.world.objects[id].type == grid::Type::door) {
      layout.world.set_door(static_cast<grid::ObjectId>(id), grid::DoorState::open);
    }
  }
}

void go_to_after_unlocking(Layout& layout) {
  const LockedRoom locked = lock_a_room(layout);
  layout.connect_all();
  scatter_in_every_room(layout, 2);
  place_agent_outside(layout, locked.room);
  layout.require_reachable();
  const grid::ObjectRange target = layout.scatter(locked.room, 1, false);
  layout.ask(Verb::go_to, layout.describe(target[0]));
}

void go_to_door(Layout& layout) {
  const grid::ObjectRange doors = add_doors(layout, 4);
  layout.place_agent(Layout::kMiddle);
  layout.ask(Verb::go_to, layout.describe(layout.pick_object(doors)));
}

void go_to_object_or_door(Layout& layout) {
  layout.place_agent(Layout::kMiddle);
  grid::ObjectRange targets = layout.scatter_objects(Layout::kMiddle);
  targets.count += add_doors(layout, 4).count;
  layout.require_reachable();
  layout.ask(Verb::go_to, layout.describe(layout.pick_object(targets)));
}

}  // namespace wordgaze::babyai::generators
