#pragma once
#include <array>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::env {

/// Which actions would do more now than let time pass: change the world, what is done of the
/// mission or what is drawn next, or end the episode. False for actions that the level does not
/// have. Found by trying each on a copy. Throws std::logic_error before the first reset.
std::array<bool, grid::kActions> effective_actions(const Environment& env);

}  // namespace wordgaze::env
