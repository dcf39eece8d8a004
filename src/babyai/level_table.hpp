#pragma once
#include <span>

#include "wordgaze/babyai/level.hpp"

namespace wordgaze::babyai {

/// Every level with a fixed id.
std::span<const LevelSpec> level_table();

}  // namespace wordgaze::babyai
