#include <utility>

#include "wordgaze/babyai/generators.hpp"

namespace wordgaze::babyai::generators {

using grid::Direction;
using grid::ObjectId;
using grid::ObjectRange;
using grid::RoomIndex;

namespace {

// Two of the objects, the first drawn first.
std::pair<ObjectId, ObjectId> draw_two(Layout& layout, ObjectRange objects) {
  const int first = layout.rng.below(objects.size());
  int second = layout.rng.below(objects.size() - 1);  // of those left
  if (second >= first) ++second;
  return {objects[first], objects[second]};
}

Clause put(const Layout& layout, ObjectId object, ObjectId next_to) {
  return {.verb = Verb::put_next,
          .object = layout.describe(object),
          .next_to = layout.describe(next_to)};
}

struct Sides {
  ObjectRange left, right;
};

// Objects in two rooms, and no wall between them.
Sides two_sides(Layout& layout) {
  layout.place_agent(RoomIndex{0, 0});
  const ObjectRange left = layout.scatter_objects(RoomIndex{0, 0});
  const ObjectRange right = layout.scatter_objects(RoomIndex{1, 0});
  layout.remove_wall({0, 0}, Direction::right);
  return {left, right};
}

// Asks for an object of one side beside one of the other; returns the object.
ObjectId put_next_to_other_side(Layout& layout) {
  const auto [left, right] = two_sides(layout);
  ObjectId object = layout.pick_object(left);
  ObjectId next_to = layout.pick_object(right);
  if (layout.coin()) std::swap(object, next_to);
  layout.task.instruction = single(put(layout, object, next_to));
  return object;
}

}  // namespace

void put_next_local(Layout& layout) {
  layout.place_agent();
  const ObjectRange objects = layout.scatter_objects();
  layout.require_reachable();
  const auto [object, next_to] = draw_two(layout, objects);
  layout.task.instruction = single(put(layout, object, next_to));
}

void put_next(Layout& layout) { put_next_to_other_side(layout); }

void put_next_carrying(Layout& layout) {
  layout.task.start_carrying = put_next_to_other_side(layout);
}

void move_two_across(Layout& layout) {
  const auto [left, right] = two_sides(layout);
  const auto [left_first, left_second] = draw_two(layout, left);
  const auto [right_first, right_second] = draw_two(layout, right);
  layout.task.instruction = ordered(single(put(layout, left_first, right_first)), Order::before,
                                    single(put(layout, right_second, left_second)));
}

}  // namespace wordgaze::babyai::generators
