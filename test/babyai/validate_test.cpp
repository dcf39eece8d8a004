#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/messages.hpp"
#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/level_edit.hpp"

namespace wordgaze::babyai {
namespace {

constexpr int kMin = std::numeric_limits<int>::min(), kMax = std::numeric_limits<int>::max();

using Change = std::function<void(LevelSpec&)>;

LevelSpec changed(const char* id, const Change& change) {
  LevelSpec level = find_level(id);
  change(level);
  return level;
}

// Refused with level, field, and value.
void expect_refused(const char* id, const Change& change, const std::string& part) {
  const LevelSpec level = changed(id, change);
  const std::string what = message_of<std::invalid_argument>([&] { validate(level); });
  EXPECT_TRUE(contains(what, id));
  EXPECT_TRUE(contains(what, part));
}

template <class P>
Change set(int P::*field, int value) {
  return [=](LevelSpec& l) { std::get<P>(l.parameters).*field = value; };
}

TEST(Validate, TakesEveryBuiltInLevel) {
  for (const LevelSpec& level : built_in_levels()) EXPECT_NO_THROW(validate(level)) << level.id;
}

TEST(Validate, SaysLevelFieldValueAndWhatIsAllowed) {
  EXPECT_EQ(message_of<std::invalid_argument>(
                [] { validate(changed("BabyAI-GoToLocal-v0", set(&Objects::count, 40))); }),
            "level 'BabyAI-GoToLocal-v0': objects = 40; expected 1 to 18");
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              validate(changed("MiniGrid-MultiRoom-N6-v0", [](LevelSpec& l) { l.room_size = 9; }));
            }),
            "level 'MiniGrid-MultiRoom-N6-v0': room_size = 9; expected 25");
}

TEST(Validate, RefusesRoomsOutOfRange) {
  for (const int size : {kMin, -1, 0, 2, 3, kMaxGridSide + 1, kMax}) {
    expect_refused(
        "BabyAI-GoToLocal-v0", [&](LevelSpec& l) { l.room_size = size; },
        "room_size = " + std::to_string(size));
  }
  for (const int rooms : {kMin, 0, 26, kMax}) {
    expect_refused(
        "BabyAI-GoTo-v0", [&](LevelSpec& l) { l.rows = rooms; }, "rows = ");
    expect_refused(
        "BabyAI-GoTo-v0", [&](LevelSpec& l) { l.columns = rooms; }, "columns = ");
  }
  expect_refused(
      "BabyAI-GoTo-v0", [](LevelSpec& l) { l.rows = 13, l.columns = 2; }, "columns * rows = 26");
  expect_refused(
      "BabyAI-GoTo-v0", [](LevelSpec& l) { l.room_size = 600; }, "cells along a side of the grid");
}

TEST(Validate, RefusesRoomsThatTheGeneratorCannotFill) {
  expect_refused(
      "BabyAI-GoToDoor-v0", [](LevelSpec& l) { l.columns = 1; }, "columns = 1");
  expect_refused(
      "BabyAI-UnlockToUnlock-v0", [](LevelSpec& l) { l.columns = 2; }, "columns = 2");
  expect_refused(
      "BabyAI-KeyCorridor-v0", [](LevelSpec& l) { l.columns = 1; }, "columns = 1");
  expect_refused(
      "BabyAI-FindObjS5-v0", [](LevelSpec& l) { l.rows = 2; }, "rows = 2");
  expect_refused(
      "BabyAI-Open-v0", [](LevelSpec& l) { l.rows = l.columns = 1; }, "rows = 1");
  expect_refused(
      "BabyAI-GoToLocal-v0", [](LevelSpec& l) { l.rows = 2; }, "rows = 2");
  expect_refused(
      "BabyAI-Unlock-v0", [](LevelSpec& l) { l.rows = l.columns = 5; }, "5 x 5 rooms");
  expect_refused(
      "MiniGrid-MemoryS7-v0", [](LevelSpec& l) { l.room_size = 5; }, "room_size = 5");
  expect_refused(
      "MiniGrid-LockedRoom-v0", [](LevelSpec& l) { l.room_size = 8; }, "room_size = 8");
}

TEST(Validate, RefusesRulesAndActionsOutOfRange) {
  const char* id = "MiniGrid-Empty-5x5-v0";
  expect_refused(
      id, [](LevelSpec& l) { l.actions = 0; }, "actions = 0");
  expect_refused(
      id, [](LevelSpec& l) { l.actions = 8; }, "actions = 8");
  expect_refused(
      id, [](LevelSpec& l) { l.max_steps = 0; }, "max_steps = 0");
  expect_refused(
      id, [](LevelSpec& l) { l.max_steps = -1; }, "max_steps = -1");
  expect_refused(
      id, [](LevelSpec& l) { l.max_steps = kMax; }, "max_steps = ");
  expect_refused(
      id, [](LevelSpec& l) { l.rule = static_cast<Rule>(99); }, "rule = 99");
  expect_refused(
      id, [](LevelSpec& l) { l.done_mode = static_cast<DoneMode>(9); }, "done_mode = 9");
  expect_refused(
      id, [](LevelSpec& l) { l.generate = nullptr; }, "no generator");
}

TEST(Validate, RefusesParametersOfAnotherFamily) {
  expect_refused(
      "MiniGrid-LavaCrossingS9N1-v0", [](LevelSpec& l) { l.parameters = Objects{3}; },
      "wants Crossings, its parameters are Objects");
  expect_refused(
      "BabyAI-GoToDoor-v0", [](LevelSpec& l) { l.parameters = Objects{3}; }, "wants none");
  expect_refused(
      "BabyAI-BossLevel-v0", [](LevelSpec& l) { l.parameters = {}; }, "wants Missions");
}

TEST(Validate, RefusesMoreObjectsThanFit) {
  for (const LevelSpec& level : built_in_levels()) {
    if (!objects(level)) continue;
    const auto with = [&](int count) {
      return [=](LevelSpec& l) {
        if (auto* p = std::get_if<Objects>(&l.parameters)) p->count = count;
        if (auto* p = std::get_if<Missions>(&l.parameters)) p->objects = count;
      };
    };
    for (const int count : {kMin, -1, max_objects(level) + 1, 63, kMax}) {
      expect_refused(level.id.c_str(), with(count), "objects = " + std::to_string(count));
    }
    EXPECT_LE(*objects(level), max_objects(level)) << level.id;
  }
  // Only 18 kinds are different, and a world holds 62 objects.
  EXPECT_EQ(max_objects(with_room(find_level("BabyAI-PutNextLocal-v0"), 30)), 18);
  EXPECT_EQ(max_objects(with_room(find_level("BabyAI-GoToLocal-v0"), 30)), 62);
  EXPECT_EQ(max_objects(find_level("BabyAI-MoveTwoAcrossS8N9-v0")), 9);
}

TEST(Validate, RefusesNumbersOfTheOtherFamiliesOutOfRange) {
  const char* task = "Wordgaze-Two-N8-K4-v0";
  for (const int clauses : {kMin, 0, 9, kMax}) {
    expect_refused(task, set(&OneRoomTask::clauses, clauses),
                   "clauses = " + std::to_string(clauses));
  }
  for (const int count : {kMin, 1, 19, kMax}) {
    expect_refused(task, set(&OneRoomTask::objects, count), "objects = " + std::to_string(count));
  }
  expect_refused("Wordgaze-Eight-N10-K8-v0", set(&OneRoomTask::objects, 7), "objects = 7");
  for (const int count : {kMin, 0, 7, kMax}) {
    expect_refused("MiniGrid-MultiRoom-N6-v0", set(&MultiRoom::rooms, count),
                   "rooms = " + std::to_string(count));
    expect_refused("MiniGrid-LavaCrossingS9N1-v0", set(&Crossings::rivers, count),
                   "rivers = " + std::to_string(count));
    expect_refused("BabyAI-OpenDoorsOrderN4-v0", set(&Doors::count, count),
                   "doors = " + std::to_string(count));
    expect_refused("MiniGrid-Dynamic-Obstacles-8x8-v0", set(&Obstacles::count, count),
                   "obstacles = " + std::to_string(count));
    expect_refused("MiniGrid-ObstructedMaze-Full-v0", set(&Maze::quarters, count),
                   "quarters = " + std::to_string(count));
  }
  for (const int side : {kMin, 3, 25, kMax}) {
    expect_refused("MiniGrid-MultiRoom-N6-v0", set(&MultiRoom::largest, side), "largest = ");
  }
  for (const int place : {kMin, -1, 3, kMax}) {
    expect_refused("MiniGrid-ObstructedMaze-1Q-v0", set(&Maze::agent_column, place),
                   "agent_column = ");
    expect_refused("MiniGrid-ObstructedMaze-1Q-v0", set(&Maze::agent_row, place), "agent_row = ");
  }
}

TEST(Validate, RefusesMissionsThatCannotBeDrawn) {
  const auto missions = [](auto change) {
    return [=](LevelSpec& l) { change(std::get<Missions>(l.parameters)); };
  };
  const char *boss = "BabyAI-BossLevel-v0", *one_room = "BabyAI-PickupLoc-v0";
  expect_refused(boss, missions([](Missions& m) { m.locked_room = 1.5; }), "locked_room = 1.5");
  expect_refused(boss, missions([](Missions& m) { m.locked_room = std::nan(""); }), "locked_room");
  expect_refused(boss, missions([](Missions& m) { m.verbs.clear(); }), "verbs is empty");
  expect_refused(boss, missions([](Missions& m) { m.forms.clear(); }), "forms is empty");
  expect_refused(boss, missions([](Missions& m) { m.verbs = {static_cast<Verb>(9)}; }),
                 "verbs = 9");
  expect_refused(one_room, missions([](Missions& m) { m.locked_room = 1; }), "locked_room = 1");
  expect_refused(one_room, missions([](Missions& m) { m.verbs = {Verb::open}; }), "\"open\" alone");
}

}  // namespace
}  // namespace wordgaze::babyai
