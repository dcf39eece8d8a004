#pragma once
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::env {

/// Throws std::runtime_error that says what is wrong unless the world is one in which a running
/// episode of the level can be: every index that the simulator will follow leads to something, and
/// what is kept twice agrees. Enums are taken to be in range.
void check_sound(const babyai::LevelSpec& level, const grid::World& world,
                 const babyai::Task& task);

}  // namespace wordgaze::env
