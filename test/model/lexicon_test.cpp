#include "wordgaze/model/lexicon.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

/// What words say of things: (A8)-(A11).
namespace wordgaze::model {
namespace {

using test::random_matrix;

constexpr int kFirstObject = 3;  // codes of one_room: unseen, empty, wall, then objects

struct LexiconTest : testing::Test {
  Design design{{}, CellAlphabet::one_room()};
  Lexicon<double>::Tables tables;
  WordTables<double> words;
  Matrix<double> scores = random_matrix(22, babyai::kVocabularySize + 1);

  LexiconTest() {
    Lexicon<double>::resize(design, tables);
    words.choice = random_matrix(1, babyai::kVocabularySize);
  }
  void speak(double focus) {
    words.focus = focus;
    Lexicon<double>::forward(design.config, words, tables, scores);
  }
  int code(int type, int color) const {
    return design.alphabet.find(
        {static_cast<std::uint8_t>(type), static_cast<std::uint8_t>(color), 0});
  }
};

TEST_F(LexiconTest, AWordSaysNothingOfWhatIsNoObject) {
  speak(0.5);
  EXPECT_EQ(scores.topLeftCorner(kFirstObject, kSilentWord).cwiseAbs().maxCoeff(), 0);
}

TEST_F(LexiconTest, WhatItSaysOfTypesAndColorsAddsUp) {
  const Matrix<double> raw = scores;
  speak(0);
  // Differences of differences vanish: no word knows a pair.
  for (int v = 0; v < babyai::kVocabularySize; ++v) {
    const double interaction = scores(code(5, 0), v) - scores(code(6, 0), v) -
                               scores(code(5, 3), v) + scores(code(6, 3), v);
    EXPECT_NEAR(interaction, 0, 1e-12);
  }
  EXPECT_GT((scores - raw).cwiseAbs().maxCoeff(), 0.1);
}

TEST_F(LexiconTest, FocusedItSpeaksOfTheAttributeThatItHasChosen) {
  // Two words that say as much of types as of colors.
  for (int t = 5; t <= 7; ++t) {
    for (int c = 0; c < 6; ++c) scores(code(t, c), 0) = 3 * (t == 5) + 5 * (c == 2);
  }
  scores.col(1) = scores.col(0);
  words.choice(0, 0) = 0.3;
  words.choice(0, 1) = -0.3;
  speak(1);
  EXPECT_NEAR(scores(code(5, 2), 0), scores(code(5, 0), 0), 1e-6);
  EXPECT_NEAR(scores(code(5, 2), 0) - scores(code(6, 2), 0), 3, 1e-6);
  EXPECT_NEAR(scores(code(5, 2), 1), scores(code(7, 2), 1), 1e-6);
  EXPECT_NEAR(scores(code(5, 2), 1) - scores(code(5, 1), 1), 5, 1e-6);
}

TEST_F(LexiconTest, UndecidedItSpeaksHalfOfBoth) {
  words.choice.setZero();
  Matrix<double> before = scores;
  speak(1);
  before.row(21).setZero();
  const auto words_of = [](const Matrix<double>& m) { return m.topLeftCorner(21, kSilentWord); };
  const Matrix<double> both = (tables.projector[0] + tables.projector[1]) * words_of(before) / 2;
  EXPECT_LT((words_of(scores) - both).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(LexiconTest, NowhereIsAShareOfTheBestMatch) {
  speak(0.3);
  for (int v = 0; v < babyai::kVocabularySize; ++v) {
    EXPECT_NEAR(scores(21, v), design.config.nowhere * scores.col(v).head(21).maxCoeff(), 1e-12);
  }
}

TEST_F(LexiconTest, ToTheSilentWordNowhereIsAsAnObjectIsInTheMean) {
  const Vector<double> before = scores.col(kSilentWord).head(21);
  speak(0.3);
  EXPECT_EQ(scores.col(kSilentWord).head(21), before);
  EXPECT_NEAR(scores(21, kSilentWord), before.tail(21 - kFirstObject).mean(), 1e-12);
}

TEST_F(LexiconTest, WordsThatSayNothingAtAllAreNoTrouble) {
  scores.setZero();
  speak(1);
  EXPECT_TRUE(scores.isZero());
}

}  // namespace
}  // namespace wordgaze::model
