#include "wordgaze/env/effect.hpp"

#include <algorithm>
#include <cstddef>

#include "wordgaze/grid/world.hpp"

namespace wordgaze::env {
namespace {

bool same(const grid::Object& a, const grid::Object& b) {
  return a.type == b.type && a.color == b.color && a.state == b.state && a.contents == b.contents &&
         a.position == b.position;
}

/// But for the count of steps.
bool same(const grid::World& a, const grid::World& b) {
  if (a.agent != b.agent || a.direction != b.direction || a.carried != b.carried) return false;
  // What stands where: objects know their places, but floors and the like may be one in many.
  for (int y = 0; y < a.grid.height(); ++y) {
    const grid::ObjectId* row = a.grid.pointer(grid::at(0, y));
    if (!std::equal(row, row + a.grid.width(), b.grid.pointer(grid::at(0, y)))) return false;
  }
  return std::ranges::equal(a.objects, b.objects,
                            [](const auto& x, const auto& y) { return same(x, y); });
}

bool changes(const Environment& before, const Environment& after, const Transition& transition) {
  const bool out_of_time = before.step_count() + 1 >= before.max_steps();
  return transition.terminated || transition.reward != 0 ||
         (transition.truncated && !out_of_time) || !same(before.world(), after.world()) ||
         before.rng().state() != after.rng().state() ||
         !std::ranges::equal(before.completion(), after.completion()) ||
         !std::ranges::equal(before.matched(), after.matched());
}

}  // namespace

std::array<bool, grid::kActions> effective_actions(const Environment& env) {
  std::array<bool, grid::kActions> effective{};
  Environment trial = env;
  for (int action = 0; action < env.num_actions(); ++action) {
    trial = env;
    const Transition transition = trial.step(static_cast<grid::Action>(action));
    effective[static_cast<std::size_t>(action)] = changes(env, trial, transition);
  }
  return effective;
}

}  // namespace wordgaze::env
