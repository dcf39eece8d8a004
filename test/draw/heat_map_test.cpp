#include "draw/heat_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "draw/color_map.hpp"
#include "evaluation/drawn_view.hpp"

namespace wordgaze::draw {
namespace {

using grid::Type;

constexpr std::array kTypes{Type::unseen, Type::empty, Type::wall, Type::floor, Type::door,
                            Type::key,    Type::ball,  Type::box,  Type::goal,  Type::lava};

Rgb at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return {p[0], p[1], p[2]};
}

TEST(HeatMap, FramesWhateverLiesInACellWithTheColorOfTheBar) {
  test::DrawnView view;
  std::array<float, grid::kViewCells> shares{};
  for (std::size_t c = 0; c < shares.size(); ++c) {
    view.put(c, kTypes[c % kTypes.size()], grid::Color::yellow);
    shares[c] = static_cast<float>(c) / 48;
  }
  for (const int size : {16, 40}) {
    const Image map = heat_map(shares, view.image, size);
    for (std::size_t c = 0; c < shares.size(); ++c) {
      const int left = static_cast<int>(c / 7) * size, top = static_cast<int>(c % 7) * size;
      // Behind the line at the left and at the top, a fifth of the cell on each side.
      int other = 0;
      for (int y = 1; y < size; ++y) {
        for (int x = 1; x < size; ++x) {
          const bool edge = std::min({x, y, size - 1 - x, size - 1 - y}) < size / 5;
          other += edge && at(map, left + x, top + y) != heat(shares[c]);
        }
      }
      EXPECT_EQ(other, 0) << "cell " << c << ", size " << size;
    }
  }
}

TEST(HeatMap, ShowsWhatLiesInACellInItsMiddle) {
  test::DrawnView view;
  view.put(0, Type::ball, grid::Color::green);
  view.put(1, Type::wall, grid::Color::grey);
  const std::array<float, grid::kViewCells> shares{1, 1, 1};
  const Image map = heat_map(shares, view.image, 40);
  EXPECT_EQ(at(map, 20, 20), (Rgb{0, 255, 0}));
  EXPECT_EQ(at(map, 20, 60), (Rgb{100, 100, 100}));
  EXPECT_EQ(at(map, 20, 100), heat(1));
}

TEST(HeatMap, HasLinesAroundSeenCellsAlone) {
  test::DrawnView view;
  for (std::size_t c = 0; c < grid::kViewCells; ++c) view.put(c, Type::unseen);
  view.put(8, Type::empty);  // column 1, row 1
  const Image map = heat_map(std::array<float, grid::kViewCells>{}, view.image, 10);
  for (const int x : {10, 20}) EXPECT_NE(at(map, x, 15), heat(0)) << x;
  for (const int y : {10, 20}) EXPECT_NE(at(map, 15, y), heat(0)) << y;
  for (const int x : {0, 30, 40}) EXPECT_EQ(at(map, x, 15), heat(0)) << x;
}

}  // namespace
}  // namespace wordgaze::draw
