#pragma once
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::grid {

/// What an action met that ends MiniGrid's episodes.
struct Events {
  bool reached_goal = false;
  bool entered_lava = false;
};

/// One action of the agent; the only place where a running world changes. (docs/simulator.md,
/// Actions)
Events step(World& world, Action action);

/// Puts what stands at a position into the agent's hand, if it can be carried and the hand is
/// empty.
void take(World& world, Position from);

}  // namespace wordgaze::grid
