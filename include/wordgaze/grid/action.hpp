#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace wordgaze::grid {

/// MiniGrid's actions, with its integers.
enum class Action : std::uint8_t { left, right, forward, pickup, drop, toggle, done };

inline constexpr int kActions = 7;

inline constexpr std::array<std::string_view, kActions> kActionNames{
    "left", "right", "forward", "pickup", "drop", "toggle", "done"};

}  // namespace wordgaze::grid
