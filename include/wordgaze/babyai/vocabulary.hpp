#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

/// The closed vocabulary of all BabyAI and MiniGrid missions.
namespace wordgaze::babyai {

using WordId = std::uint8_t;

inline constexpr WordId kPadding = 0;

/// Words by id: padding first, then alphabetical. The comma of ", then" is a word.
inline constexpr auto kWords = std::to_array<std::string_view>(
    {"",         ",",      "a",    "after",    "and",    "at",     "avoid",   "ball",
     "behind",   "blue",   "box",  "door",     "end",    "fetch",  "find",    "from",
     "front",    "get",    "go",   "goal",     "green",  "grey",   "hallway", "in",
     "key",      "lava",   "left", "matching", "must",   "near",   "next",    "object",
     "of",       "on",     "open", "opening",  "pick",   "purple", "put",     "reach",
     "red",      "right",  "room", "rooms",    "square", "the",    "then",    "to",
     "traverse", "unlock", "up",   "use",      "yellow", "you",    "your"});

inline constexpr int kVocabularySize = static_cast<int>(kWords.size());  ///< padding included

/// The longest mission of the grammar, its comma counted as a word.
inline constexpr int kMaxMissionWords = 73;

constexpr std::string_view word(WordId id) { return kWords[id]; }

constexpr std::optional<WordId> word_id(std::string_view text) {
  const auto found = std::lower_bound(kWords.begin() + 1, kWords.end(), text);
  if (found == kWords.end() || *found != text) return std::nullopt;
  return static_cast<WordId>(found - kWords.begin());
}

}  // namespace wordgaze::babyai
