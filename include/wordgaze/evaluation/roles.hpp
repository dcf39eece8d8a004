#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "wordgaze/babyai/progress.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::evaluation {

/// What a cell of the view means to the mission; docs/metrics.md.
enum class Role : std::uint8_t {
  target,      ///< an object of a sub-task whose turn it is
  named,       ///< an object of another sub-task
  distractor,  ///< any other key, ball, box or door
  empty,       ///< empty cells and floor
  wall,
  unseen,
  other,  ///< goal, lava
};
inline constexpr std::size_t kRoles = 7;
constexpr std::array<std::string_view, kRoles> names(Role) {
  return {"target", "named", "distractor", "empty", "wall", "unseen", "other"};
}
constexpr bool is_object(Role role) { return role <= Role::distractor; }

/// What a thing is by its looks: places such as "on your left" are not asked for.
Role role_of(grid::Type type, grid::Color color, const babyai::Progress& progress);

using Roles = std::array<Role, grid::kViewCells>;

/// The roles of the 49 cells.
Roles roles_of(std::span<const std::uint8_t, grid::kImageBytes> image,
               const babyai::Progress& progress);

}  // namespace wordgaze::evaluation
