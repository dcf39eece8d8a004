#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// The closed vocabulary of all BabyAI and MiniGrid missions.
namespace wordgaze::babyai {

using WordId = std::uint8_t;

inline constexpr WordId kPadding = 0;

/// Words by id: padding first. The comma of ", then" is a word. Trained weights know words by their
/// ids, so that the order is kept for ever: a new word goes to the end, and into the test that pins
/// the ids (test/babyai/vocabulary_test.cpp); no word is moved or taken out.
inline constexpr auto kWords = std::to_array<std::string_view>(
    {"",         ",",      "a",    "after",    "and",    "at",     "avoid",   "ball",
     "behind",   "blue",   "box",  "door",     "end",    "fetch",  "find",    "from",
     "front",    "get",    "go",   "goal",     "green",  "grey",   "hallway", "in",
     "key",      "lava",   "left", "matching", "must",   "near",   "next",    "object",
     "of",       "on",     "open", "opening",  "pick",   "purple", "put",     "reach",
     "red",      "right",  "room", "rooms",    "square", "the",    "then",    "to",
     "traverse", "unlock", "up",   "use",      "yellow", "you",    "your"});

inline constexpr int kVocabularySize = static_cast<int>(kWords.size());  ///< padding included

/// The most words of a mission, its commas counted: enough for what all levels ask for. An
/// instruction of one's own may be too long.
inline constexpr int kMaxMissionWords = 73;

constexpr std::string_view word(WordId id) { return kWords[id]; }

namespace detail {
/// The ids in alphabetical order of their words.
constexpr auto alphabetical() {  // a function of its own: cppcheck 2.10 cannot read it in place
  std::array<WordId, kWords.size()> ids{};
  for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<WordId>(k);
  std::sort(ids.begin(), ids.end(), [](WordId a, WordId b) { return word(a) < word(b); });
  return ids;
}
inline constexpr auto kAlphabetical = alphabetical();
static_assert(std::adjacent_find(kAlphabetical.begin(), kAlphabetical.end(),
                                 [](WordId a, WordId b) { return word(a) == word(b); }) ==
                  kAlphabetical.end(),
              "a word is in the vocabulary twice");
}  // namespace detail

constexpr std::optional<WordId> word_id(std::string_view text) {
  const auto found =
      std::lower_bound(detail::kAlphabetical.begin(), detail::kAlphabetical.end(), text,
                       [](WordId id, std::string_view t) { return word(id) < t; });
  if (text.empty() || found == detail::kAlphabetical.end() || word(*found) != text) {
    return std::nullopt;
  }
  return *found;
}

}  // namespace wordgaze::babyai
