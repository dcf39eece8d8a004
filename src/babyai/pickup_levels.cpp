#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/stages.hpp"

namespace wordgaze::babyai::generators {

using grid::Direction;
using grid::ObjectId;
using grid::ObjectRange;
using grid::RoomIndex;
using grid::Type;

void pick_up(Layout& layout) {
  layout.place_agent();
  layout.connect_all();
  const ObjectRange objects = layout.scatter_objects();
  layout.require_reachable();
  layout.ask(Verb::pickup, layout.describe(layout.pick_object(objects)));
}

void unblock_and_pick_up(Layout& layout) {
  layout.place_agent();
  layout.connect_all();
  const ObjectRange objects = layout.scatter_objects();
  if (layout.all_reachable()) throw grid::Rejected{};
  layout.ask(Verb::pickup, layout.describe(layout.pick_object(objects)));
}

void pick_up_among_distractors(Layout& layout) {
  const ObjectRange objects = layout.scatter_objects();
  layout.place_agent(RoomIndex{});
  Description target = layout.describe(layout.pick_object(objects));
  enum class By { type, color, both };
  constexpr std::array kBy{By::type, By::color, By::both};
  const By by = layout.pick(kBy);
  if (by == By::type) target.color.reset();
  if (by == By::color) target.type.reset();
  layout.ask(Verb::pickup, target);
}

void pick_up_above(Layout& layout) {
  const ObjectId object = layout.add_object({1, 0});
  layout.add_door(Layout::kMiddle, Direction::up, {}, false);
  layout.place_agent(Layout::kMiddle);
  layout.connect_all();
  layout.ask(Verb::pickup, layout.describe(object));
}

void pick_up_only_ball(Layout& layout) {
  const ObjectId ball = layout.add_object({}, Type::ball);
  layout.place_agent();
  layout.ask(Verb::pickup, layout.describe_type(ball));
}

void find_object(Layout& layout) {
  const int column = layout.rng.below(layout.rows());
  const int row = layout.rng.below(layout.columns());
  const ObjectId object = layout.add_object({column, row});
  layout.place_agent(Layout::kMiddle);
  layout.connect_all();
  layout.ask(Verb::pickup, layout.describe_type(object));
}

void key_corridor(Layout& layout) {
  layout.ask(Verb::pickup, layout.describe_type(object_off_corridor(layout)));
}

}  // namespace wordgaze::babyai::generators
