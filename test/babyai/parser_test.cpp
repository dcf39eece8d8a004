#include "wordgaze/babyai/parser.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "grid/drawn_world.hpp"
#include "support/messages.hpp"
#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/core/rng.hpp"
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
  ids.insert(ids.end(),
             {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0", "Wordgaze-Three-N8-K4-v0",
              "Wordgaze-Four-N8-K4-v0", "Wordgaze-Five-N8-K8-v0", "Wordgaze-Eight-N8-K8-v0"});
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
  EXPECT_EQ(i.order[1], Order::any);
  EXPECT_EQ(i.order[2], Order::before);
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
  for (const Case& c : std::vector<Case>{
           {"walk to the ball", "walk"},
           {"go to ball", "ball"},
           {"go to the rde ball", "rde"},
           {"go to the red", ""},
           {"go to the ball quickly", "quickly"},
           {"go to the ball, pick up the key", "pick"},
           {"go to the ball on your back", "back"},
           {"put the ball near the key", "near"},
           {"go to the ball and open the door and open a door", "and open a"},
           {"go to a key after you go to a box, then open a door after you", "after you"},
           {"", ""},
           {"Go to the ball", "Go"},
           {"go to the ball.", "ball."}}) {
    try {
      parse_mission(c.text);
      FAIL() << c.text;
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      const std::size_t column = c.column_of.empty() ? c.text.size() : c.text.rfind(c.column_of);
      EXPECT_TRUE(what.ends_with('\n' + std::string(column + 2, ' ') + '^')) << what;
    }
  }
}

TEST(ParseMission, TakesEightClausesAndNotNine) {
  std::string text = "go to a ball";
  for (int n = 1; n < 8; ++n) text += n % 2 == 0 ? ", then go to a ball" : " and go to a ball";
  EXPECT_EQ(parse_mission(text).clauses(), 8);
  const auto what =
      message_of<std::invalid_argument>([&] { parse_mission(text + ", then open a door"); });
  EXPECT_TRUE(contains(what, "expected at most 8 clauses, found 'open'")) << what;
}

TEST(ParseMission, ReadsAChainOfParts) {
  const Instruction i = parse_mission(
      "go to a ball, then go to a key and go to a box after you open a door, then pick up a key");
  using enum Order;
  ASSERT_EQ(i.clauses(), 5);
  EXPECT_EQ(std::vector(i.order.begin() + 1, i.order.begin() + 5),
            (std::vector{before, any, after, before}));
  std::vector<int> turns;
  for (auto part = i.first(); part.size() > 0; part = i.next(part)) {
    for (int k = part.begin; k < part.end; ++k) turns.push_back(k);
  }
  EXPECT_EQ(turns, (std::vector{3, 4, 0, 1, 2}));
}

Description any_description(core::Rng& rng) {
  constexpr std::array kTypes{Type::ball, Type::box, Type::key, Type::door};
  Description d;
  if (rng.below(2) == 0) d.color = grid::kColorsToDraw[static_cast<std::size_t>(rng.below(6))];
  if (rng.below(4) > 0) d.type = kTypes[static_cast<std::size_t>(rng.below(4))];
  if (rng.below(4) == 0) d.location = static_cast<Location>(rng.below(5));
  return d;
}

Instruction any_instruction(int clauses, core::Rng& rng) {
  Instruction i;
  while (i.clauses() < clauses) {
    const std::size_t k = i.count++;
    i.clause[k] = {.verb = static_cast<Verb>(rng.below(4)), .object = any_description(rng)};
    if (i.clause[k].verb == Verb::put_next) i.clause[k].next_to = any_description(rng);
    if (k == 0) continue;
    do {
      i.order[k] = static_cast<Order>(rng.below(3));
    } while (!is_grammatical(i));
  }
  return i;
}

TEST(ParseMission, ReadsAnyInstructionAsItIsWorded) {
  const grid::World world = grid::drawn({"#######", "#K.>Bc#", "#######"});
  core::Rng rng(1);
  for (int clauses = 1; clauses <= Instruction::kMaxClauses; ++clauses) {
    int short_enough = 0;
    for (int n = 0; n < 300; ++n) {
      const Instruction i = any_instruction(clauses, rng);
      try {
        const Sentence sentence = wording(i, look_up(world, i));
        ASSERT_EQ(parse_mission(text(sentence)), i) << text(sentence);
        ++short_enough;
      } catch (const std::length_error&) {
      }
    }
    EXPECT_GT(short_enough, 100) << clauses;
  }
}

}  // namespace
}  // namespace wordgaze::babyai
