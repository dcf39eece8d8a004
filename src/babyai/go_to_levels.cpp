#include "generators.hpp"

namespace wordgaze::babyai::generators {
namespace {

Instruction go_to(const Description& object) {
  return single({.verb = Verb::go_to, .object = object});
}

}  // namespace

void go_to_local(Layout& layout) {
  layout.place_agent();
  const grid::ObjectRange objects = layout.scatter(std::nullopt, layout.level.objects, false);
  layout.require_reachable();
  layout.task.instruction = go_to(layout.describe(layout.pick_object(objects)));
}

}  // namespace wordgaze::babyai::generators
