#include "generators.hpp"

namespace wordgaze::babyai::generators {
namespace {

Clause draw_clause(Layout& layout, grid::ObjectId target) {
  constexpr std::array kVerbs{Verb::go_to, Verb::pickup};
  return {.verb = layout.pick(kVerbs), .object = layout.describe(target)};
}

}  // namespace

// Wordgaze-One and Wordgaze-Two: one or two of the objects in the room are targets.
void one_room_task(Layout& layout) {
  layout.place_agent();
  const grid::ObjectRange objects =
      layout.scatter(std::nullopt, layout.level.objects, layout.level.unique);
  layout.require_reachable();

  const int first = layout.rng.below(objects.size());
  if (layout.level.clauses == 1) {
    layout.task.instruction = single(draw_clause(layout, objects[first]));
    return;
  }
  // The second target is drawn from those left.
  int second = layout.rng.below(objects.size() - 1);
  if (second >= first) ++second;
  if (layout.describe(objects[first]) == layout.describe(objects[second])) throw grid::Rejected{};
  const Clause a = draw_clause(layout, objects[first]);
  const Clause b = draw_clause(layout, objects[second]);
  constexpr std::array kJoins{Order::any, Order::before, Order::after};
  const Order order = layout.pick(kJoins);
  layout.task.instruction = order == Order::any ? both(a, b) : ordered(single(a), order, single(b));
}

}  // namespace wordgaze::babyai::generators
