#include "draw/color_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wordgaze::draw {
namespace {

double lightness(Rgb c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(Magma, GoesFromBlackToLightYellow) {
  EXPECT_EQ(magma(0), (Rgb{0, 0, 4}));
  EXPECT_EQ(magma(0.5), (Rgb{183, 55, 121}));
  EXPECT_EQ(magma(1), (Rgb{252, 253, 191}));
}

TEST(Magma, GrowsLighterWithTheValue) {
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GT(lightness(magma(i / 100.0)), lightness(magma((i - 1) / 100.0))) << i;
  }
}

TEST(Magma, TakesAnyNumber) {
  EXPECT_EQ(magma(-1), magma(0));
  EXPECT_EQ(magma(std::numeric_limits<double>::infinity()), magma(1));
  EXPECT_EQ(magma(std::nan("")), magma(0));
}

TEST(Heat, IsTheSquareRootOnTheBar) {
  EXPECT_EQ(heat(0), magma(0));
  EXPECT_EQ(heat(0.25), magma(0.5));
  EXPECT_EQ(heat(1), magma(1));
}

TEST(Heat, TakesAnyNumber) {
  EXPECT_EQ(heat(-1), heat(0));
  EXPECT_EQ(heat(7), heat(1));
  EXPECT_EQ(heat(std::nan("")), heat(0));
}

}  // namespace
}  // namespace wordgaze::draw
