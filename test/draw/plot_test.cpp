#include "wordgaze/draw/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/messages.hpp"

namespace wordgaze::draw {
namespace {

std::vector<std::string> texts(double low, double high, int count) {
  std::vector<std::string> result;
  for (const Tick& tick : ticks(low, high, count)) result.push_back(tick.text);
  return result;
}

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts(0, 1, 5), (Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(0, 2e6, 4), (Texts{"0", "0.5M", "1.0M", "1.5M", "2.0M"}));
  EXPECT_EQ(texts(-3, 12, 4), (Texts{"0", "5", "10"}));
  EXPECT_EQ(texts(0, 45000, 5), (Texts{"0", "10k", "20k", "30k", "40k"}));
  EXPECT_EQ(texts(-0.02, 0.02, 4), (Texts{"-0.02", "-0.01", "0", "0.01", "0.02"}));
}

Plot example() {
  return {.title = "Success",
          .x_label = "frames",
          .y_label = "rate",
          .series = {{.name = "one", .x = {0, 1, 2}, .y = {0, 0.5, 1}}},
          .y_range = {{0, 1}},
          .width = 600,
          .height = 400};
}

long pixels_of(const Image& image, Rgb color) {
  long count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      count += Rgb{p[0], p[1], p[2]} == color;
    }
  }
  return count;
}

constexpr Rgb kFirstColor{0, 114, 178};

TEST(LinePlot, DrawsEachSeries) {
  Plot plot = example();
  const Image image = line_plot(plot);
  EXPECT_EQ(image.width, 600);
  EXPECT_EQ(image.height, 400);
  EXPECT_GT(pixels_of(image, kFirstColor), 200);
  plot.series.push_back({.name = "two", .x = {0, 2}, .y = {1, 0}});
  EXPECT_NE(line_plot(plot), image);
}

TEST(LinePlot, LeavesAGapWhereAValueIsNotANumber) {
  Plot plot = example();
  const long whole = pixels_of(line_plot(plot), kFirstColor);
  plot.series[0].y[2] = std::nan("");
  const long half = pixels_of(line_plot(plot), kFirstColor);
  EXPECT_LT(half, whole * 3 / 4);
  EXPECT_GT(half, whole / 4);
}

TEST(LinePlot, DrawsABand) {
  Plot plot = example();
  plot.series[0].low = {0, 0.2, 0.5};
  plot.series[0].high = {0.5, 0.8, 1};
  EXPECT_NE(line_plot(plot), line_plot(example()));
}

TEST(LinePlot, FindsAPlaceForAConstantAndForASinglePoint) {
  Plot plot = example();
  plot.y_range.reset();
  plot.series = {{.name = "one", .x = {3}, .y = {0}}};
  EXPECT_GT(pixels_of(line_plot(plot), kFirstColor), 0);
}

TEST(LinePlot, RefusesWhatItCannotDraw) {
  const auto refusal = [](const Series& series) {
    Plot plot = example();
    plot.series = {series};
    return message_of<std::invalid_argument>([&] { line_plot(plot); });
  };
  EXPECT_EQ(refusal({.name = "a", .x = {1, 2}, .y = {1}}), "line_plot: series 'a' has 2 x and 1 y");
  EXPECT_EQ(refusal({.name = "a", .x = {1}, .y = {1}, .low = {1}}),
            "line_plot: series 'a' has 1 points and a band of 1 and 0");
  EXPECT_TRUE(contains(refusal({.name = "a", .x = {1}, .y = {std::nan("")}}), "no finite point"));
}

}  // namespace
}  // namespace wordgaze::draw
