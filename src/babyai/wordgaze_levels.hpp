#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "wordgaze/babyai/level.hpp"

namespace wordgaze::babyai {

/// The level of an id Wordgaze-{One,Two,Three,Four}-N{N}-K{K}[-auto]-v0, not validated; nothing for
/// other ids.
std::optional<LevelSpec> wordgaze_level(std::string_view id);

/// The id of such a level by its numbers.
std::string wordgaze_id(const LevelSpec& level);

}  // namespace wordgaze::babyai
