#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/model/missions.hpp"

namespace wordgaze::policy {

using model::kMaxSubTasks;

/// What an agent is told before each decision: a value, from an environment (environment.hpp), a
/// robot's camera or a message.
struct Observation {
  /// The 7x7 view, [x][y][type, color, state]; the agent stands at (3, 6) and looks toward y = 0.
  std::array<std::uint8_t, grid::kImageBytes> image{};
  /// c_t: 1 for sub-tasks that are done, 0 for the others and behind the last one.
  std::array<std::uint8_t, kMaxSubTasks> completion{};
  babyai::Sentence sentence{};   ///< the mission; without words there is nothing to look for
  int actions = grid::kActions;  ///< that are possible: the first so many
};

}  // namespace wordgaze::policy
