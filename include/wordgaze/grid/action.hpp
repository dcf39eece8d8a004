#pragma once
#include <cstdint>

namespace wordgaze::grid {

/// MiniGrid's actions, with its integers.
enum class Action : std::uint8_t { left, right, forward, pickup, drop, toggle, done };

inline constexpr int kActions = 7;

}  // namespace wordgaze::grid
