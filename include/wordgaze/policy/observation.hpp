#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::policy {

/// The most sub-tasks that a completion vector tells of.
inline constexpr std::size_t kMaxSubTasks = 16;

/// What an agent is told before each decision: a value, from an environment (environment.hpp), a
/// robot's camera or a message.
struct Observation {
  /// The 7x7 view, [x][y][type, color, state]; the agent stands at (3, 6) and looks toward y = 0.
  std::array<std::uint8_t, grid::kImageBytes> image{};
  /// c_t: 1 for sub-tasks that are done, 0 for the others and behind the last one.
  std::array<std::uint8_t, kMaxSubTasks> completion{};
  babyai::Sentence sentence{};  ///< the mission
};

}  // namespace wordgaze::policy
