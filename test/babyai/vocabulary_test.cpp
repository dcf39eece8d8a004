#include "wordgaze/babyai/vocabulary.hpp"

#include <gtest/gtest.h>

namespace wordgaze::babyai {
namespace {

// Append new words; whoever changes what is here voids all trained weights.
constexpr auto kForEver = std::to_array<std::string_view>(
    {"",         ",",      "a",    "after",    "and",    "at",     "avoid",   "ball",
     "behind",   "blue",   "box",  "door",     "end",    "fetch",  "find",    "from",
     "front",    "get",    "go",   "goal",     "green",  "grey",   "hallway", "in",
     "key",      "lava",   "left", "matching", "must",   "near",   "next",    "object",
     "of",       "on",     "open", "opening",  "pick",   "purple", "put",     "reach",
     "red",      "right",  "room", "rooms",    "square", "the",    "then",    "to",
     "traverse", "unlock", "up",   "use",      "yellow", "you",    "your"});

TEST(Vocabulary, KeepsTheIdsThatTrainedWeightsKnow) {
  ASSERT_GE(kWords.size(), kForEver.size());
  for (std::size_t k = 0; k < kForEver.size(); ++k) EXPECT_EQ(kWords[k], kForEver[k]) << k;
  EXPECT_EQ(kVocabularySize, 55) << "a word was appended: pin its id here too";
}

TEST(Vocabulary, FindsEachWordByItsId) {
  EXPECT_EQ(word(kPadding), "");
  for (int id = 1; id < kVocabularySize; ++id) {
    EXPECT_EQ(word_id(word(static_cast<WordId>(id))), id);
  }
}

TEST(Vocabulary, KnowsNoOtherWords) {
  for (const char* text : {"", "gone", "Ball", "aa", "zebra", " "}) {
    EXPECT_FALSE(word_id(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace wordgaze::babyai
