#pragma once
#include <string_view>

#include "wordgaze/babyai/instruction.hpp"

namespace wordgaze::babyai {

/// Reads a mission of the Baby language:
///
///     mission      part | part ", then" part | part "after you" part
///     part         clause | clause "and" clause
///     clause       "go to" D | "pick up" D | "open" D | "put" D "next to" D
///     D            "the" or "a", [color], "ball" "box" "key" "door" or "object", [location]
///     location     "in front of you" | "behind you" | "on your left" | "on your right"
///
/// The article says nothing: "the" and "a" mean whatever fits. Throws std::invalid_argument that
/// points at the first word outside the grammar.
Instruction parse_mission(std::string_view text);

}  // namespace wordgaze::babyai
