#include "wordgaze/training/stretch.hpp"

#include <gtest/gtest.h>

#include <string>

namespace wordgaze::training {
namespace {

/// A view as text, far rows first: '?' unseen, '.' floor, '#' wall, 'o' an object.
std::string stretched(const Stretch& stretch, const std::string& drawn) {
  const auto alphabet = model::CellAlphabet::one_room();
  const std::string kinds = "?.#o";
  Vector<std::uint8_t> cells(grid::kViewCells);
  const auto cell = [&](int x, int y) -> std::uint8_t& { return cells(grid::kViewSize * x + y); };
  for (int i = 0; i < grid::kViewCells; ++i) {
    cell(i % 7, i / 7) = static_cast<std::uint8_t>(kinds.find(drawn[static_cast<std::size_t>(i)]));
  }
  stretch.apply(alphabet, cells);
  std::string result;
  for (int i = 0; i < grid::kViewCells; ++i) result += kinds[cell(i % 7, i / 7)];
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
