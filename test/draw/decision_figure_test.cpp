#include "wordgaze/draw/decision_figure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "draw/color_map.hpp"
#include "support/messages.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::draw {
namespace {

/// A decision in a small room with made-up attention: every word looks at cell 0.
class DecisionFigure : public ::testing::Test {
 protected:
  explicit DecisionFigure(const char* id = "Wordgaze-One-N8-K4-v0") : env_(id) {
    env_.reset(std::uint64_t{1});
    env_.observe(image_);
    const auto words = static_cast<std::size_t>(env_.sentence().length);
    weights_.assign(words, 1.0f / static_cast<float>(words));
    mask_.assign(words, 1);
    attention_.assign(words * grid::kViewCells, 0.01f);
    for (std::size_t word = 0; word < words; ++word) attention_[word * grid::kViewCells] = 0.52f;
    map_.assign(attention_.begin(), attention_.begin() + grid::kViewCells);
    step_.logits = logits_;
    step_.word_weights = weights_;
    step_.word_mask = mask_;
    step_.word_attention = attention_;
    step_.attention_map = map_;
  }

  Image draw() const { return decision_figure(step_, {env_.world(), env_.sentence(), env_.id()}); }

  std::array<std::uint8_t, grid::kImageBytes> image_{};
  env::Environment env_;
  std::array<float, 7> logits_{1, 0, 3, 0, 0, 0, -9};
  std::vector<float> weights_, mask_, attention_, map_;
  policy::StepRecord step_{.image = image_};
};

long pixels_of(const Image& image, Rgb color) {
  long count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    count += Rgb{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]} == color;
  }
  return count;
}

TEST_F(DecisionFigure, ShowsTheHottestCellOfMInTheBrightestColor) {
  EXPECT_EQ(draw().width, 1200);
  // Cell 0 of a large map has 40 x 40 pixels, of which lines take a few.
  EXPECT_GT(pixels_of(draw(), magma(1)), 1500);
}

TEST_F(DecisionFigure, ShowsTheMaskOnlyWhenItDimsAWord) {
  const int height = draw().height;
  mask_[1] = 0.5f;
  EXPECT_GT(draw().height, height);
}

TEST_F(DecisionFigure, LeavesOutTheMapsOfABaseline) {
  const int height = draw().height;
  step_.word_weights = step_.word_mask = step_.word_attention = step_.attention_map = {};
  const Image figure = draw();
  EXPECT_LT(figure.height, height);
  EXPECT_EQ(pixels_of(figure, magma(1)), 0);
}

TEST_F(DecisionFigure, SurvivesNumbersThatAreNone) {
  const float nan = std::nanf("");
  map_.assign(map_.size(), nan);
  weights_.assign(weights_.size(), nan);
  attention_.assign(attention_.size(), nan);
  logits_.fill(nan);
  step_.value = std::numeric_limits<float>::infinity();
  EXPECT_EQ(draw().width, 1200);
  map_.assign(map_.size(), 0);
  EXPECT_EQ(draw().width, 1200);
}

TEST_F(DecisionFigure, RefusesArraysThatDoNotFit) {
  step_.word_weights = step_.word_weights.first(2);
  EXPECT_TRUE(contains(message_of<std::invalid_argument>([&] { draw(); }),
                       "2 word weights for a mission of 5 words"));
  step_.word_weights = weights_;
  step_.attention_map = step_.attention_map.first(48);
  EXPECT_TRUE(contains(message_of<std::invalid_argument>([&] { draw(); }), "a map of 48"));
}

class DecisionFigureOfALongMission : public DecisionFigure {
 protected:
  DecisionFigureOfALongMission() : DecisionFigure("BabyAI-BossLevel-v0") {}
};

TEST_F(DecisionFigureOfALongMission, GrowsDownward) {
  ASSERT_GT(env_.sentence().length, 8);
  EXPECT_EQ(draw().width, 1200);
  EXPECT_GT(draw().height, 800);
}

}  // namespace
}  // namespace wordgaze::draw
