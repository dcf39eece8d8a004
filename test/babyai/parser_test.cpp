#include "wordgaze/babyai/parser.hpp"

#include <gtest/gtest.h>

#include <string>

#include "wordgaze/env/environment.hpp"

namespace wordgaze::babyai {
namespace {

using grid::Color;
using grid::Type;

// What a text does not tell.
Instruction without_strictness(Instruction instruction) {
  instruction.strict = false;
  for (Clause& clause : instruction.clause) clause.strict = false;
  return instruction;
}

class GeneratedMission : public testing::TestWithParam<std::string> {};

TEST_P(GeneratedMission, IsReadAsItWasMeant) {
  env::Environment env(GetParam());
  env.reset(17);
  for (int n = 0; n < 25; ++n, env.reset()) {
    EXPECT_EQ(parse_mission(env.mission()), without_strictness(env.instruction())) << env.mission();
  }
}

std::vector<std::string> babyai_ids() {
  std::vector<std::string> ids = level_ids();
  std::erase_if(ids, [](const std::string& id) { return !id.starts_with("BabyAI-"); });
  ids.insert(ids.end(), {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0",
                         "Wordgaze-Three-N8-K4-v0", "Wordgaze-Four-N8-K4-v0"});
  return ids;
}

INSTANTIATE_TEST_SUITE_P(, GeneratedMission, testing::ValuesIn(babyai_ids()), [](const auto& test) {
  std::string name = test.param;
  std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
  return name;
});

TEST(ParseMission, ReadsEveryPart) {
  const Instruction i = parse_mission(
      "put the red ball on your left next to a door in front of you and open the grey door, then "
      "pick up a box");
  ASSERT_EQ(i.clauses(), 3);
  EXPECT_EQ(i.order, Order::before);
  EXPECT_EQ(i.first_part, 2);
  EXPECT_EQ(i.clause[0],
            (Clause{.verb = Verb::put_next,
                    .object = {.type = Type::ball, .color = Color::red, .location = Location::left},
                    .next_to = {.type = Type::door, .location = Location::front}}));
  EXPECT_EQ(i.clause[1],
            (Clause{.verb = Verb::open, .object = {.type = Type::door, .color = Color::grey}}));
  EXPECT_EQ(i.clause[2], (Clause{.verb = Verb::pickup, .object = {.type = Type::box}}));
}

TEST(ParseMission, ReadsTheObjectOfAnyType) {
  EXPECT_EQ(parse_mission("go to the object behind you").clause[0].object,
            (Description{.location = Location::behind}));
  EXPECT_EQ(parse_mission("pick up the blue object").clause[0].object,
            (Description{.color = Color::blue}));
}

TEST(ParseMission, PointsAtTheFirstWordThatDoesNotFit) {
  struct Case {
    std::string text, column_of;
  };
  for (const Case& c :
       std::vector<Case>{{"walk to the ball", "walk"},
                         {"go to ball", "ball"},
                         {"go to the rde ball", "rde"},
                         {"go to the red", ""},
                         {"go to the ball quickly", "quickly"},
                         {"go to the ball, pick up the key", "pick"},
                         {"go to the ball on your back", "back"},
                         {"put the ball near the key", "near"},
                         {"go to the ball and open the door and open a door", "and open a"},
                         {"", ""},
                         {"Go to the ball", "Go"},
                         {"go to the ball.", "ball."}}) {
    try {
      parse_mission(c.text);
      FAIL() << c.text;
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      const std::size_t column = c.column_of.empty() ? c.text.size() : c.text.find(c.column_of);
      EXPECT_TRUE(what.ends_with('\n' + std::string(column + 2, ' ') + '^')) << what;
    }
  }
}

}  // namespace
}  // namespace wordgaze::babyai
