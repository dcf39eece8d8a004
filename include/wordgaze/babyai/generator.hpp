#pragma once
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::babyai {

/// Draws an episode of a level: layouts until one is not rejected. False when that took too many
/// tries; the reference would go on for ever. Throws std::logic_error for a generator whose layout
/// is none: without an agent, an instruction, or the target that it names.
[[nodiscard]] bool generate(const LevelSpec& level, core::Rng& rng, grid::World& world, Task& task);

/// The step limit that BabyAI gives an instruction in the rooms of a level.
int step_limit(const LevelSpec& level, const Instruction& instruction);

}  // namespace wordgaze::babyai
