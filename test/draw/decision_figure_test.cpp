#include "wordgaze/draw/decision_figure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "draw/color_map.hpp"
#include "draw/palette.hpp"
#include "support/messages.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::draw {
namespace {

/// A decision in a small room with made-up attention: every word looks at cell 0.
class DecisionFigure : public ::testing::Test {
 protected:
  explicit DecisionFigure(const char* id = "Wordgaze-One-N8-K4-v0") : env_(id) {
    env_.reset(std::uint64_t{1});
    env_.observe(image_);
    progress_ = env_.progress();
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

  Image draw() const {
    return decision_figure(step_, {env_.world(), env_.sentence(), progress_, env_.id()});
  }

  std::array<std::uint8_t, grid::kImageBytes> image_{};
  env::Environment env_;
  babyai::Progress progress_;
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

// A cell of M has 40 x 40 pixels; lines and what lies in it take some.
constexpr long kMostOfACell = 900;

TEST_F(DecisionFigure, ShowsAShareInTheSameColorWhateverTheOthersAre) {
  for (const float other : {0.0f, 0.1f, 0.6f}) {
    map_.assign(map_.size(), 0);
    map_[0] = 0.3f;
    map_[1] = other;
    EXPECT_GT(pixels_of(draw(), heat(0.3f)), kMostOfACell) << other;
  }
  map_[0] = 0.2f;
  EXPECT_LT(pixels_of(draw(), heat(0.3f)), 20);  // of the color bar
}

TEST_F(DecisionFigure, ShowsAWeightAtTheSameLengthWhateverTheOthersAre) {
  step_.logits = {};  // whose bars have the color of the weights
  const auto drawn = [&](float first, float second) {
    weights_.assign(weights_.size(), 0);
    weights_[0] = first;
    weights_[1] = second;
    return pixels_of(draw(), kAccent);
  };
  const long half = drawn(0.5f, 0);
  EXPECT_GT(half, 100);
  EXPECT_EQ(drawn(0, 1), 2 * half);
  EXPECT_EQ(drawn(0.5f, 1), 3 * half);
}

TEST_F(DecisionFigure, PalesAWordThatCountsForNothing) {
  EXPECT_EQ(pixels_of(draw(), kPale), 0);
  weights_[2] = 0;
  EXPECT_GT(pixels_of(draw(), kPale), 0);
  weights_[2] = weights_[1];
  mask_[2] = 0;
  EXPECT_GT(pixels_of(draw(), kPale), 0);
}

TEST_F(DecisionFigure, SaysNotInViewExactlyIfMIsMostlyNowhere) {
  attention_[0] = 0;  // the first word has .52 nowhere
  const auto says_not_in_view = [&](float share) {
    map_.assign(map_.size(), (1 - share) / static_cast<float>(map_.size()));
    const Image figure = draw();
    EXPECT_GT(pixels_of(figure, heat(share)), 300) << share;  // the 50th place, 18 x 18
    return pixels_of(figure, kAlarm) > 0;
  };
  EXPECT_TRUE(says_not_in_view(0.97f));
  EXPECT_TRUE(says_not_in_view(0.52f));
  EXPECT_FALSE(says_not_in_view(0.48f));
  EXPECT_FALSE(says_not_in_view(0));
}

TEST_F(DecisionFigure, DoesNotTakeADimMissionForNowhere) {
  const int height = draw().height;
  mask_.assign(mask_.size(), 0.996f);  // not so dim that the mask is shown
  map_.assign(map_.size(), 0.001f);
  const Image figure = draw();
  EXPECT_EQ(pixels_of(figure, kAlarm), 0);
  EXPECT_EQ(figure.height, height);
}

TEST_F(DecisionFigure, FramesTargetsInTheWorldAndInEveryView) {
  progress_ = {};
  EXPECT_EQ(pixels_of(draw(), kTarget), 0);

  // The mission is about the first object in view, and its turn comes.
  const auto add = [&](bool turn) {
    for (std::size_t c = 0; c < grid::kViewCells; ++c) {
      const auto type = static_cast<grid::Type>(image_[3 * c]);
      if (!grid::is_object(type)) continue;
      const auto color = static_cast<grid::Color>(image_[3 * c + 1]);
      progress_.add({.type = type, .color = color}, false, turn);
      return true;
    }
    return false;
  };
  ASSERT_TRUE(add(false));
  EXPECT_EQ(pixels_of(draw(), kTarget), 0);
  ASSERT_TRUE(add(true));
  const long everywhere = pixels_of(draw(), kTarget);

  step_.word_weights = step_.word_mask = step_.word_attention = step_.attention_map = {};
  const long without_maps = pixels_of(draw(), kTarget);
  image_.fill(0);
  const long in_the_world = pixels_of(draw(), kTarget);
  EXPECT_GT(in_the_world, 0);
  EXPECT_GT(without_maps, in_the_world);
  EXPECT_GT(everywhere - without_maps, 500 + 100 * 5);  // around the cell of M and those of 5 words
}

TEST_F(DecisionFigure, SaysHowTheViewIsTurned) {
  grid::World world = env_.world();
  // The line below the view, which does not depend on what stands in the panels.
  const auto line = [&](grid::Direction direction) {
    world.direction = direction;
    const Image figure = decision_figure(step_, {world, env_.sentence(), progress_, env_.id()});
    std::vector<std::uint8_t> bytes;
    for (int y = 424; y < 444; ++y) {
      bytes.insert(bytes.end(), figure.pixel(352, y), figure.pixel(640, y));
    }
    return bytes;
  };
  std::set<std::vector<std::uint8_t>> lines;
  for (int quarter = 0; quarter < 4; ++quarter) {
    lines.insert(line(grid::turned(grid::Direction::right, quarter)));
  }
  EXPECT_EQ(lines.size(), 4);
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
  EXPECT_EQ(pixels_of(figure, heat(0.52f)), 0);
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
