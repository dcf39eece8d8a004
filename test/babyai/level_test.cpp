#include "wordgaze/babyai/level.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/messages.hpp"
#include "wordgaze/babyai/generator.hpp"
#include "wordgaze/babyai/level_edit.hpp"

namespace wordgaze::babyai {
namespace {

TEST(Level, IsKnownForEveryIdOfTheReference) {
  const std::vector<std::string> ids = level_ids();
  const auto of = [&](std::string_view family) {
    return std::count_if(ids.begin(), ids.end(),
                         [&](const std::string& id) { return id.starts_with(family); });
  };
  EXPECT_EQ(of("BabyAI-"), 96);
  EXPECT_EQ(of("MiniGrid-"), 76);
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
}

int clauses(const LevelSpec& level) { return std::get<OneRoomTask>(level.parameters).clauses; }

TEST(Level, TakesItsNumbersFromTheName) {
  const LevelSpec level = find_level("Wordgaze-Two-N12-K5-v0");
  EXPECT_EQ(level.room_size, 12);
  EXPECT_EQ(objects(level), 5);
  EXPECT_EQ(clauses(level), 2);
  EXPECT_EQ(level.done_mode, DoneMode::sequential);
  EXPECT_EQ(clauses(find_level("Wordgaze-Four-N10-K4-v0")), 4);
  EXPECT_EQ(clauses(find_level("Wordgaze-Eight-N10-K8-v0")), 8);
  EXPECT_EQ(find_level("Wordgaze-One-N8-K4-auto-v0").done_mode, DoneMode::off);
}

TEST(Level, RefusesNamesThatOnlyResembleOne) {
  for (const char* id : {"Wordgaze-One-N8-K4", "Wordgaze-One-N8-K4-v0 ", "Wordgaze-One-N8-K4-v1",
                         "Wordgaze-Nine-N8-K9-v0", "Wordgaze-One-N-K4-v0", "Wordgaze-One-N8-K-4-v0",
                         "Wordgaze-One-N88888-K4-v0", "Wordgaze-One-N8-K4-auto-auto-v0", ""}) {
    EXPECT_THROW(find_level(id), std::invalid_argument) << id;
  }
}

TEST(Level, LimitsStepsByTheAreaAndTheInstruction) {
  const LevelSpec maze = find_level("BabyAI-SynthS5R2-v0");
  const Clause go{.verb = Verb::go_to}, put{.verb = Verb::put_next};
  EXPECT_EQ(step_limit(maze, single(go)), 150);
  EXPECT_EQ(step_limit(maze, ordered(both(go, put), Order::after, single(put))), 5 * 150);
  EXPECT_EQ(step_limit(find_level("BabyAI-KeyCorridor-v0"), single(go)), 1080);
}

TEST(Instruction, RefusesToOrderWhatTheGrammarDoesNot) {
  const Instruction a = single({}), after = ordered(a, Order::after, a);
  EXPECT_THROW(ordered(after, Order::before, a), std::invalid_argument);
  EXPECT_THROW(ordered(a, Order::after, after), std::invalid_argument);
  EXPECT_THROW(ordered(a, Order::any, a), std::invalid_argument);
  EXPECT_THROW(ordered(a, Order::before, {}), std::invalid_argument);
  Instruction eight = a;
  while (eight.clauses() < Instruction::kMaxClauses) eight = ordered(eight, Order::before, a);
  EXPECT_TRUE(is_grammatical(eight));
  EXPECT_THROW(ordered(eight, Order::before, a), std::invalid_argument);
}

TEST(Instruction, KnowsTheGrammar) {
  using enum Order;
  const auto joined = [](std::initializer_list<Order> orders) {
    Instruction i{.count = static_cast<std::uint8_t>(orders.size() + 1)};
    std::copy(orders.begin(), orders.end(), i.order.begin() + 1);
    return is_grammatical(i);
  };
  EXPECT_TRUE(joined({any, before, any, after, before, any}));
  EXPECT_FALSE(joined({any, any}));
  EXPECT_FALSE(joined({after, before, after}));
  EXPECT_FALSE(joined({static_cast<Order>(3)}));
  EXPECT_FALSE(is_grammatical({.count = 9}));
}

TEST(FindLevel, SaysThatARoomIsTooLarge) {
  const auto refusal = [](const std::string& id) {
    return message_of<std::invalid_argument>([&] { find_level(id); });
  };
  EXPECT_TRUE(contains(refusal("Wordgaze-One-N99999-K4-v0"), "room_size = 99999; expected "));
  EXPECT_TRUE(contains(refusal("Wordgaze-One-N99999999999-K4-v0"), "room_size = 2147483647"));
  EXPECT_TRUE(contains(refusal("Wordgaze-One-N8-K99999-v0"), "objects = 99999; expected "));
  EXPECT_TRUE(contains(refusal("BabyAI-GoToLocal-v0[room_size=5000]"), "room_size = 5000"));
  EXPECT_TRUE(contains(refusal("BabyAI-GoToLocal-v0[room_size=99999999999]"), "too large"));
}

TEST(FindLevel, RefusesNovelsAtOnce) {
  for (const std::string& id :
       {"Wordgaze-" + std::string(26'300, 'a'), std::string(1'000'000, 'x'),
        "Wordgaze-One-N" + std::string(1'000'000, '9') + "-K4-v0", std::string(1'000'000, '['),
        "BabyAI-GoToLocal-v0[room_size=" + std::string(1'000'000, '7') + "]"}) {
    const auto message = message_of<std::invalid_argument>([&] { find_level(id); });
    EXPECT_LT(message.size(), 1000u);
  }
}

}  // namespace
}  // namespace wordgaze::babyai
