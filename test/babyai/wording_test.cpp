#include "wordgaze/babyai/wording.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "grid/drawn_world.hpp"
#include "support/messages.hpp"
#include "wordgaze/babyai/parser.hpp"

namespace wordgaze::babyai {
namespace {

Sentence worded(std::string_view mission, const std::vector<std::string_view>& rows) {
  const Instruction instruction = parse_mission(mission);
  return wording(instruction, look_up(grid::drawn(rows), instruction));
}

TEST(Wording, SaysTheForOneAndAForSeveral) {
  EXPECT_EQ(text(worded("go to a ball", {"#####", "#>.B#", "#####"})), "go to the ball");
  EXPECT_EQ(text(worded("go to the ball", {"#####", "#>bB#", "#####"})), "go to a ball");
}

TEST(Wording, WritesTheCommaBehindItsWord) {
  EXPECT_EQ(
      text(worded("open the red door, then put the ball in front of you next to the key behind you",
                  {"#######", "#K.>Bc#", "#######"})),
      "open the red door, then put the ball in front of you next to the key behind you");
}

TEST(Wording, TellsWhichSubTaskAWordBelongsTo) {
  const Sentence s = worded("go to the ball and pick up the key after you open the door",
                            {"#######", "#K.>Bc#", "#######"});
  EXPECT_EQ(text(s), "go to the ball and pick up the key after you open the door");
  const std::vector<int> sub_tasks(s.sub_task_of.begin(), s.sub_task_of.begin() + s.length);
  EXPECT_EQ(sub_tasks, (std::vector{0, 0, 0, 0, -1, 1, 1, 1, 1, -1, -1, 2, 2, 2}));
}

TEST(Wording, SplitsPutNextIntoItsHalves) {
  const Sentence s =
      worded("put the ball next to the key and open the door", {"#######", "#K.>Bc#", "#######"});
  EXPECT_EQ(text(s), "put the ball next to the key and open the door");
  const std::vector<int> sub_tasks(s.sub_task_of.begin(), s.sub_task_of.begin() + s.length);
  EXPECT_EQ(sub_tasks, (std::vector{0, 0, 0, 1, 1, 1, 1, -1, 2, 2, 2}));
}

TEST(Wording, KeepsTheLongestMissionOfBabyAi) {
  const std::string d = "the purple ball in front of you";
  const std::string clause = "put " + d + " next to " + d;
  const std::string part = clause + " and " + clause;
  EXPECT_EQ(worded(part + " after you " + part, {">B"}).length, 72);
  const Sentence longest = worded(part + ", then " + part, {">B"});
  EXPECT_EQ(longest.length, 72);  // with the comma
  EXPECT_LE(longest.length, kMaxMissionWords);
  EXPECT_EQ(text(longest).size(), 317u);
}

TEST(Wording, HasWordsForEightClausesOfTheLongestLevel) {
  std::string longest = "pick up the purple ball";
  for (int n = 1; n < Instruction::kMaxClauses; ++n) longest += ", then pick up the purple ball";
  EXPECT_EQ(worded(longest, {">B"}).length, 54);
  // But not for eight of any kind.
  const std::string put = "put the purple ball next to the purple ball";
  std::string too_long = put;
  for (int n = 1; n < Instruction::kMaxClauses; ++n) too_long += ", then " + put;
  EXPECT_THROW(worded(too_long, {">B"}), std::length_error);
}

TEST(Sentence, IsReadFromText) {
  const Sentence s = sentence_of("unlock the door,  go");
  EXPECT_EQ(s.length, 5);
  EXPECT_EQ(word(s.words[3]), ",");
  EXPECT_EQ(text(s), "unlock the door, go");
  EXPECT_THROW(sentence_of("go to the moon"), std::invalid_argument);
  EXPECT_EQ(sentence_of("").length, 0);
}

TEST(Sentence, NamesAllWordsThatAreUnknown) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { sentence_of("fly to the moon"); }),
            "mission 'fly to the moon': not in the vocabulary: 'fly', 'moon'");
}

}  // namespace
}  // namespace wordgaze::babyai
