#pragma once
#include <string_view>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/babyai/sentence.hpp"

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

/// The words of a mission, each with its sub-task where it is of the Baby language; those of other
/// missions ("get to the green goal square") are all of one sub-task. Throws as sentence_of() does.
Sentence parse_sentence(std::string_view text);

}  // namespace wordgaze::babyai
