#include "wordgaze/evaluation/roles.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

#include "evaluation/drawn_view.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::evaluation {
namespace {

using grid::Color;
using grid::Type;

// Sub-tasks, each with whether its turn has come.
babyai::Progress turns(std::initializer_list<std::pair<babyai::Description, bool>> sub_tasks) {
  babyai::Progress progress;
  for (const auto& [object, turn] : sub_tasks) progress.add(object, false, turn);
  return progress;
}

TEST(Roles, AreThoseOfTheSubTaskWhoseTurnItIs) {
  const babyai::Description ball{.type = Type::ball, .color = Color::red};
  const babyai::Description key{.type = Type::key, .color = Color::blue};
  test::DrawnView view;
  view.put(0, Type::ball, Color::red);
  view.put(1, Type::key, Color::blue);
  view.put(2, Type::key, Color::red);
  view.put(3, Type::wall, Color::grey);
  view.put(4, Type::unseen);
  view.put(5, Type::lava);
  view.put(6, Type::floor, Color::blue);
  const Roles first = roles_of(view.image, turns({{ball, true}, {key, false}}));
  EXPECT_EQ(first[0], Role::target);
  EXPECT_EQ(first[1], Role::named);
  EXPECT_EQ(first[2], Role::distractor);
  EXPECT_EQ(first[3], Role::wall);
  EXPECT_EQ(first[4], Role::unseen);
  EXPECT_EQ(first[5], Role::other);
  EXPECT_EQ(first[6], Role::empty);
  EXPECT_EQ(first[7], Role::empty);
  const Roles second = roles_of(view.image, turns({{ball, false}, {key, true}}));
  EXPECT_EQ(second[0], Role::named);
  EXPECT_EQ(second[1], Role::target);
}

TEST(Roles, FitDescriptionsThatLeaveColorOrTypeOpen) {
  test::DrawnView view;
  view.put(0, Type::box, Color::red);
  view.put(1, Type::box, Color::green);
  view.put(2, Type::wall, Color::red);
  const Roles roles = roles_of(view.image, turns({{{.color = Color::red}, true}}));
  EXPECT_EQ(roles[0], Role::target);
  EXPECT_EQ(roles[1], Role::distractor);
  EXPECT_EQ(roles[2], Role::wall);
}

TEST(Roles, OfPutNextAreOneObjectAtATime) {
  env::Environment environment("BabyAI-PutNextLocal-v0");
  environment.reset(3);
  const auto& clause = environment.instruction().clause[0];
  test::DrawnView view;
  view.put(0, *clause.object.type, *clause.object.color);
  view.put(1, *clause.next_to.type, *clause.next_to.color);
  const Roles before = roles_of(view.image, environment.progress());
  EXPECT_EQ(before[0], Role::target);
  EXPECT_EQ(before[1], Role::named);
  environment.take_object(
      static_cast<grid::ObjectId>(std::countr_zero(environment.meaning().object[0])));
  const Roles after = roles_of(view.image, environment.progress());
  EXPECT_EQ(after[0], Role::named);
  EXPECT_EQ(after[1], Role::target);
}

}  // namespace
}  // namespace wordgaze::evaluation
