#include "wordgaze/training/stretch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace wordgaze::training {
namespace {

/// A view as text, far rows first: '?' unseen, '.' floor, '#' wall, 'o' an object.
std::string stretched(const Stretch& stretch, const std::string& drawn) {
  const std::string drawing = "?.#o";
  constexpr std::array<std::uint8_t, 4> types{0, 1, 2, 6};
  std::array<std::uint8_t, grid::kImageBytes> image{};
  const auto cell = [&](int i) -> std::uint8_t& {
    return image[static_cast<std::size_t>(3 * (grid::kViewSize * (i % 7) + i / 7))];
  };
  for (int i = 0; i < grid::kViewCells; ++i) {
    cell(i) = types[drawing.find(drawn[static_cast<std::size_t>(i)])];
  }
  stretch.apply(image);
  std::string result;
  for (int i = 0; i < grid::kViewCells; ++i) {
    const auto type = std::find(types.begin(), types.end(), cell(i)) - types.begin();
    result += drawing[static_cast<std::size_t>(type)];
  }
  return result;
}

const std::string kView =
    "???????"
    "#######"
    "#..o..#"
    "#.....#"
    "#.o...#"
    "#.....#"
    "#....o#";

TEST(Stretch, LeavesTheViewAsItIsByDefault) { EXPECT_EQ(stretched({}, kView), kView); }

TEST(Stretch, InsertsFloorAheadBehindWhatIsNear) {
  EXPECT_EQ(stretched({.ahead = {.near = 2, .gap = 2}, .aside = {}}, kView),
            "#..o..#"
            "#.....#"
            "?.....?"
            "?.....?"
            "#.o...#"
            "#.....#"
            "#....o#");
}

TEST(Stretch, InsertsFloorToBothSides) {
  EXPECT_EQ(stretched({.ahead = {}, .aside = {.near = 1, .gap = 1}}, kView),
            "???????"
            "#?###?#"
            "...o..."
            "......."
            "..o...."
            "......."
            "......o");
}

TEST(Stretch, ShowsNothingBehindAWall) {
  const std::string facing =
      "???????"
      "???????"
      "???????"
      "???????"
      "???????"
      "#######"
      "#.....#";
  EXPECT_EQ(stretched({.ahead = {.near = 1, .gap = 5}, .aside = {}}, facing), facing);
}

TEST(Stretch, KeepsWhatTheAgentTouches) {
  core::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Stretch s = Stretch::draw(rng);
    for (const int distance : {0, 1}) EXPECT_EQ(s.ahead.source(distance), distance);
    EXPECT_FALSE(s.ahead.inserts(1));
    EXPECT_FALSE(s.aside.inserts(0));
  }
}

}  // namespace
}  // namespace wordgaze::training
