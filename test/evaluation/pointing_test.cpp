#include "wordgaze/evaluation/pointing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/drawn_view.hpp"

namespace wordgaze::evaluation {
namespace {

using grid::Color;
using grid::Type;
using Map = std::array<float, grid::kViewCells>;

Roles empty_view() {
  Roles roles;
  roles.fill(Role::empty);
  return roles;
}

Map bright_at(std::size_t cell) {
  Map map{};
  map[cell] = 1;
  return map;
}

TEST(Brightest, IsTheFirstOfEqualCells) {
  Map map{};
  map[7] = map[40] = 2;
  EXPECT_EQ(brightest(map), 7u);
}

TEST(Pointing, CountsWhereATargetIsInView) {
  Pointing pointing;
  Roles roles = empty_view();
  pointing.add(bright_at(3), roles);  // nothing to point at
  EXPECT_TRUE(std::isnan(pointing.target.value()));
  roles[3] = Role::target;
  roles[4] = Role::distractor;
  pointing.add(bright_at(3), roles);
  pointing.add(bright_at(4), roles);
  pointing.add(bright_at(5), roles);
  pointing.add(bright_at(3), roles);
  EXPECT_EQ(pointing.target.count, 4);
  EXPECT_DOUBLE_EQ(pointing.target.value(), 0.5);
  EXPECT_DOUBLE_EQ(pointing.target_chance.value(), 0.5);  // one of two objects
}

TEST(Pointing, TakesTargetsAsNamedButNotTheOtherWayRound) {
  Pointing pointing;
  Roles roles = empty_view();
  roles[1] = Role::target;
  roles[2] = Role::named;
  roles[3] = Role::distractor;
  pointing.add(bright_at(2), roles);
  EXPECT_DOUBLE_EQ(pointing.target.value(), 0);
  EXPECT_DOUBLE_EQ(pointing.named.value(), 1);
  EXPECT_DOUBLE_EQ(pointing.named_chance.value(), 2.0 / 3);
}

TEST(WordPointing, AsksAColorForColorAndATypeForType) {
  test::DrawnView view;
  view.put(10, Type::key, Color::red);
  view.put(11, Type::ball, Color::blue);
  view.put(12, Type::wall, Color::grey);
  const auto sentence = babyai::sentence_of("go to the red ball");
  std::vector<float> maps(5 * grid::kViewCells, 0.0f);
  maps[3 * grid::kViewCells + 10] = 1;  // red: the red key
  maps[4 * grid::kViewCells + 11] = 1;  // ball: the blue ball
  WordPointing words;
  words.add(maps, sentence, view.image);
  EXPECT_EQ(words.color.count, 1);
  EXPECT_EQ(words.type.count, 1);
  EXPECT_DOUBLE_EQ(words.color.value(), 1);
  EXPECT_DOUBLE_EQ(words.type.value(), 1);
  maps[4 * grid::kViewCells + 10] = 2;  // now the key
  words.add(maps, sentence, view.image);
  EXPECT_DOUBLE_EQ(words.type.value(), 0.5);
}

TEST(WordPointing, DoesNotTakeAWallForAGreyObject) {
  test::DrawnView view;
  view.put(12, Type::wall, Color::grey);
  const auto sentence = babyai::sentence_of("grey");
  WordPointing words;
  words.add(bright_at(12), sentence, view.image);
  EXPECT_EQ(words.color.count, 0);
  view.put(13, Type::box, Color::grey);
  words.add(bright_at(12), sentence, view.image);
  EXPECT_DOUBLE_EQ(words.color.value(), 0);
}

}  // namespace
}  // namespace wordgaze::evaluation
