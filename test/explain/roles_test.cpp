#include "wordgaze/explain/roles.hpp"

#include <gtest/gtest.h>

#include "explain/drawn_view.hpp"

namespace wordgaze::explain {
namespace {

using babyai::Order;
using grid::Color;
using grid::Type;

TEST(Roles, AreThoseOfTheClauseWhoseTurnItIs) {
  const auto mission = babyai::ordered(test::go_to(Type::ball, Color::red), Order::before,
                                       test::go_to(Type::key, Color::blue));
  test::DrawnView view;
  view.put(0, Type::ball, Color::red);
  view.put(1, Type::key, Color::blue);
  view.put(2, Type::key, Color::red);
  view.put(3, Type::wall, Color::grey);
  view.put(4, Type::unseen);
  view.put(5, Type::lava);
  view.put(6, Type::floor, Color::blue);
  const Roles first = roles_of(view.image, mission, test::flags({1, 0}));
  EXPECT_EQ(first[0], Role::target);
  EXPECT_EQ(first[1], Role::named);
  EXPECT_EQ(first[2], Role::distractor);
  EXPECT_EQ(first[3], Role::wall);
  EXPECT_EQ(first[4], Role::unseen);
  EXPECT_EQ(first[5], Role::other);
  EXPECT_EQ(first[6], Role::empty);
  EXPECT_EQ(first[7], Role::empty);
  const Roles second = roles_of(view.image, mission, test::flags({0, 1}));
  EXPECT_EQ(second[0], Role::named);
  EXPECT_EQ(second[1], Role::target);
}

TEST(Roles, FitDescriptionsThatLeaveColorOrTypeOpen) {
  auto mission = test::go_to(Type::ball, Color::red);
  mission.clause[0].object.type.reset();
  test::DrawnView view;
  view.put(0, Type::box, Color::red);
  view.put(1, Type::box, Color::green);
  view.put(2, Type::wall, Color::red);
  const Roles roles = roles_of(view.image, mission, test::flags({1}));
  EXPECT_EQ(roles[0], Role::target);
  EXPECT_EQ(roles[1], Role::distractor);
  EXPECT_EQ(roles[2], Role::wall);
}

TEST(Roles, HoldBothObjectsOfPutNext) {
  auto mission = test::go_to(Type::ball, Color::red);
  mission.clause[0].verb = babyai::Verb::put_next;
  mission.clause[0].next_to = {.type = Type::box, .color = Color::grey};
  test::DrawnView view;
  view.put(0, Type::ball, Color::red);
  view.put(1, Type::box, Color::grey);
  const Roles roles = roles_of(view.image, mission, test::flags({1}));
  EXPECT_EQ(roles[0], Role::target);
  EXPECT_EQ(roles[1], Role::target);
}

}  // namespace
}  // namespace wordgaze::explain
