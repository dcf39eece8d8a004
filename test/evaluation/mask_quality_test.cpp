#include "wordgaze/evaluation/mask_quality.hpp"

#include <gtest/gtest.h>

namespace wordgaze::evaluation {
namespace {

/// "red and blue": a word a clause.
babyai::Sentence two_clauses() {
  babyai::Sentence s;
  s.append(babyai::word_id("red").value(), 0);
  s.append(babyai::word_id("and").value(), -1);
  s.append(babyai::word_id("blue").value(), 1);
  return s;
}

TEST(MaskQuality, CountsTheWordsOfClausesOnly) {
  MaskQuality mask;
  EXPECT_TRUE(mask.add(std::array{0.9f, 0.0f, 0.1f}, two_clauses(), 0b01));
  EXPECT_EQ(mask.true_positive, 1);
  EXPECT_EQ(mask.true_negative, 1);
  EXPECT_DOUBLE_EQ(mask.f1(), 1);
  EXPECT_NEAR(mask.bright.value(), 0.9, 1e-6);
  EXPECT_NEAR(mask.dark.value(), 0.1, 1e-6);
}

TEST(MaskQuality, HasTheF1OfItsCounts) {
  MaskQuality mask;
  EXPECT_FALSE(mask.add(std::array{0.9f, 1.0f, 0.9f}, two_clauses(), 0b01));  // one false positive
  EXPECT_FALSE(mask.add(std::array{0.1f, 1.0f, 0.9f}, two_clauses(), 0b11));  // one false negative
  EXPECT_DOUBLE_EQ(mask.precision(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(mask.recall(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(mask.f1(), 2.0 / 3);
}

TEST(MaskDelay, CountsTheStepsUntilTheMaskFollows) {
  MaskDelay delay;
  delay.add(0, true, 0b00, true);
  delay.add(0, false, 0b01, false);  // changed, not yet followed
  delay.add(0, false, 0b01, false);
  delay.add(0, false, 0b01, true);  // two steps later
  delay.add(0, false, 0b01, false);
  EXPECT_EQ(delay.changes(), 1);
  EXPECT_EQ(delay.at_once(), 0);
  EXPECT_DOUBLE_EQ(delay.steps().value(), 2);
  delay.add(0, false, 0b11, true);
  EXPECT_EQ(delay.at_once(), 1);
  EXPECT_DOUBLE_EQ(delay.steps().value(), 1);
}

TEST(MaskDelay, KeepsLanesAndEpisodesApart) {
  MaskDelay delay;
  delay.add(0, true, 0b01, false);  // an episode may begin with a clause done: no change
  delay.add(1, true, 0b00, true);
  delay.add(1, false, 0b10, false);
  delay.add(0, false, 0b01, true);
  delay.add(1, true, 0b00, true);  // ended before the mask followed
  EXPECT_EQ(delay.changes(), 1);
  EXPECT_EQ(delay.steps().count, 0);
}

}  // namespace
}  // namespace wordgaze::evaluation
