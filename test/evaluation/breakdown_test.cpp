#include "wordgaze/evaluation/breakdown.hpp"

#include <gtest/gtest.h>

namespace wordgaze::evaluation {
namespace {

using babyai::Order;
using babyai::Verb;

const babyai::Clause kGo{.verb = Verb::go_to}, kPick{.verb = Verb::pickup};

TEST(Breakdown, NamesVerbsAndJoinsInTheOrderOfTheSentence) {
  Breakdown b;
  b.add(babyai::single(kGo), true);
  b.add(babyai::both(kGo, kPick), true);
  b.add(babyai::ordered(babyai::single(kPick), Order::after, babyai::single(kGo)), false);
  b.add(babyai::ordered(babyai::both(kGo, kGo), Order::before, babyai::both(kGo, kPick)), true);
  const auto three = babyai::ordered(babyai::single(kGo), Order::before, babyai::both(kGo, kGo));
  b.add(babyai::ordered(three, Order::after, babyai::single(kGo)), true);
  EXPECT_EQ(b.by_join.at("then, and, after").successes, 1);
  EXPECT_EQ(b.by_verb.at("go to").episodes, 1);
  EXPECT_EQ(b.by_verb.at("go to, pick up").successes, 1);
  EXPECT_EQ(b.by_verb.at("pick up, go to").successes, 0);
  EXPECT_EQ(b.by_join.at("none").episodes, 1);
  EXPECT_EQ(b.by_join.at("and").episodes, 1);
  EXPECT_EQ(b.by_join.at("after").successes, 0);
  EXPECT_EQ(b.by_join.at("and, then, and").successes, 1);
  EXPECT_EQ(b.by_clauses.at("2").episodes, 2);
  EXPECT_DOUBLE_EQ(b.by_clauses.at("2").success_rate(), 0.5);
}

TEST(Breakdown, CountsAnEpisodeOnceForEachObjectNamed) {
  using grid::Color;
  using grid::Type;
  const babyai::Description red_ball{.type = Type::ball, .color = Color::red};
  const babyai::Description box{.type = Type::box}, grey{.color = Color::grey};
  Breakdown b;
  b.add(babyai::single({.verb = Verb::go_to, .object = red_ball}), true);
  b.add(babyai::both({.verb = Verb::pickup, .object = red_ball},
                     {.verb = Verb::go_to, .object = red_ball}),
        false);
  b.add(babyai::single({.verb = Verb::put_next, .object = box, .next_to = grey}), true);
  EXPECT_EQ(b.by_object.at("red ball").episodes, 2);
  EXPECT_EQ(b.by_object.at("red ball").successes, 1);
  EXPECT_EQ(b.by_object.at("box").episodes, 1);
  EXPECT_EQ(b.by_object.at("grey object").successes, 1);
  EXPECT_EQ(b.by_object.size(), 3u);
}

TEST(Breakdown, AddsUpOverWorkers) {
  Breakdown a, b;
  a.add(babyai::single(kGo), true);
  b.add(babyai::single(kGo), false);
  b.add(babyai::single(kPick), true);
  a += b;
  EXPECT_EQ(a.by_verb.at("go to").episodes, 2);
  EXPECT_EQ(a.by_verb.at("go to").successes, 1);
  EXPECT_EQ(a.by_verb.at("pick up").successes, 1);
}

}  // namespace
}  // namespace wordgaze::evaluation
