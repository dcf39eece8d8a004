#pragma once
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {

/// 1 at the start of an episode, 0.1 at its end: what success is worth.
double reward(const grid::World& world, const babyai::Task& task);

/// One step of MiniGrid's own levels, whatever rule they have. (docs/simulator.md, Actions and
/// Levels)
Transition step_by_rule(babyai::Rule rule, grid::World& world, const babyai::Task& task,
                        core::Rng& rng, grid::Action action);

}  // namespace wordgaze::env
