#include "wordgaze/model/task_scan.hpp"

#include <gtest/gtest.h>

#include "model/agent_fixture.hpp"

/// The scan with gates as they are learned: what it says of missions longer than any it was taught.
namespace wordgaze::model {
namespace {

using test::sentence;

struct TaskScanTest : testing::Test {
  TaskScan<double>::Params p;

  TaskScanTest() {
    constexpr double kSure = 20;
    TaskScan<double>::resize(p);
    p.words.topRows(3).setConstant(-kSure);
    p.words.row(3).setConstant(5);
    p.rules.setConstant(10);
    const auto set = [&](const char* word, std::initializer_list<int> gates) {
      const Index id = babyai::word_id(word).value();
      for (const int gate : gates) p.words(gate, id) = kSure;
      p.words(3, id) = -5;
    };
    set("and", {0, 1});
    set("then", {0, 1});
    set(",", {});
    set("after", {0, 2});
    set("you", {});
  }

  /// The words that are bright once the sub-tasks in `done` are.
  std::string bright(const std::string& text, std::initializer_list<std::size_t> done) const {
    Missions missions;
    Mission mission{sentence(text), {}};
    for (const std::size_t i : done) mission.done[i] = 1;
    missions.index_of(mission);
    Matrix<double> mask(babyai::kMaxMissionWords, 1);
    TaskScan<double>::Cache cache;
    TaskScan<double>::forward(p, missions, cache, mask);
    std::string words;
    for (int i = 0; i < mission.length; ++i) {
      const double alpha = mask(i, 0);
      EXPECT_TRUE(alpha < 0.01 || alpha > 0.99) << alpha;
      if (alpha < 0.5) continue;
      if (!words.empty()) words += ' ';
      words += babyai::word(mission.words[static_cast<std::size_t>(i)]);
    }
    return words;
  }
};

TEST_F(TaskScanTest, TakesClausesInTheirOrder) {
  const std::string mission = "open red and open blue , then open green and open grey";
  EXPECT_EQ(bright(mission, {}), "open red");
  EXPECT_EQ(bright(mission, {0}), "open blue");
  EXPECT_EQ(bright(mission, {0, 1}), "open green");
  EXPECT_EQ(bright(mission, {0, 1, 2}), "open grey");
  EXPECT_EQ(bright(mission, {0, 1, 2, 3}), "");
}

TEST_F(TaskScanTest, WhatComesAfterYouComesFirst) {
  const std::string mission =
      "open red , then open blue and open green after you open grey , then open yellow";
  EXPECT_EQ(bright(mission, {}), "open grey");
  EXPECT_EQ(bright(mission, {3}), "open yellow");
  EXPECT_EQ(bright(mission, {3, 4}), "open red");
  EXPECT_EQ(bright(mission, {3, 4, 0}), "open blue");
  EXPECT_EQ(bright(mission, {3, 4, 0, 1}), "open green");
}

TEST_F(TaskScanTest, EightClausesAreNoLongerThanTwo) {
  std::string mission = "open red";
  for (const char* color : {"green", "blue", "purple", "yellow", "grey"}) {
    mission += std::string(" , then open ") + color;
  }
  mission += " and open door , then open box";
  EXPECT_EQ(bright(mission, {0, 1, 2, 3}), "open yellow");
  EXPECT_EQ(bright(mission, {0, 1, 2, 3, 4, 5}), "open door");
  EXPECT_EQ(bright(mission, {0, 1, 2, 3, 4, 5, 6}), "open box");
}

}  // namespace
}  // namespace wordgaze::model
