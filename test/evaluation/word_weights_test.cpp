#include "wordgaze/evaluation/word_weights.hpp"

#include <gtest/gtest.h>

#include "evaluation/words.hpp"

namespace wordgaze::evaluation {
namespace {

TEST(Words, HaveContentWhenTheyNameAColorOrAType) {
  const auto content = [](std::string_view word) {
    return is_content(babyai::word_id(word).value());
  };
  for (const char* word : {"red", "grey", "key", "ball", "box", "door"}) EXPECT_TRUE(content(word));
  for (const char* word : {"go", "pick", "the", "and", "object", "goal"}) {
    EXPECT_FALSE(content(word)) << word;
  }
}

TEST(WordWeights, ComparesContentWordsWithFunctionWords) {
  WordWeights weights;
  weights.add(std::array{0.1f, 0.1f, 0.1f, 0.3f, 0.4f}, babyai::sentence_of("go to the red ball"));
  EXPECT_NEAR(weights.content.value(), 0.35, 1e-6);
  EXPECT_NEAR(weights.function.value(), 0.1, 1e-6);
  EXPECT_NEAR(weights.content_share.value(), 0.7, 1e-6);
  EXPECT_NEAR(weights.even_share.value(), 0.4, 1e-12);
}

}  // namespace
}  // namespace wordgaze::evaluation
