#include "wordgaze/babyai/level_edit.hpp"

#include <gtest/gtest.h>

#include "support/messages.hpp"

namespace wordgaze::babyai {
namespace {

TEST(LevelEdit, KnowsHowManyObjectsALevelScatters) {
  EXPECT_EQ(objects(find_level("BabyAI-GoToLocal-v0")), 8);
  EXPECT_EQ(objects(find_level("BabyAI-BossLevel-v0")), 18);
  EXPECT_EQ(objects(find_level("Wordgaze-Two-N8-K4-v0")), 4);
  for (const char* id :
       {"MiniGrid-MultiRoom-N6-v0", "MiniGrid-LavaCrossingS9N1-v0",
        "MiniGrid-Dynamic-Obstacles-8x8-v0", "BabyAI-OpenDoorsOrderN4-v0", "BabyAI-KeyInBox-v0"}) {
    EXPECT_EQ(objects(find_level(id)), std::nullopt) << id;
    EXPECT_EQ(max_objects(find_level(id)), 0) << id;
  }
}

TEST(LevelEdit, ChangesTheNumbersInAWordgazeId) {
  const LevelSpec one = find_level("Wordgaze-One-N8-K4-v0");
  EXPECT_EQ(with_room(with_objects(one, 8), 12).id, "Wordgaze-One-N12-K8-v0");
  const LevelSpec judged = find_level("Wordgaze-Three-N8-K4-auto-v0");
  EXPECT_EQ(with_objects(judged, 5).id, "Wordgaze-Three-N8-K5-auto-v0");
}

TEST(LevelEdit, TellsInTheIdWhatIsDifferentInOtherLevels) {
  const LevelSpec level = find_level("BabyAI-GoToLocal-v0");
  const LevelSpec both = edited(level, {.room_size = 10, .objects = 4});
  EXPECT_EQ(both.id, "BabyAI-GoToLocal-v0[room_size=10][objects=4]");
  EXPECT_EQ(with_room(with_objects(level, 4), 10).id, both.id);
  EXPECT_EQ(with_objects(level, 4).id, "BabyAI-GoToLocal-v0[objects=4]");
  EXPECT_EQ(with_objects(level, 8).id, level.id);
  EXPECT_EQ(with_objects(both, 6).id, "BabyAI-GoToLocal-v0[room_size=10][objects=6]");
}

TEST(LevelEdit, IsFoundByItsId) {
  const LevelSpec level = find_level("BabyAI-GoToLocal-v0[room_size=10][objects=4]");
  EXPECT_EQ(level.id, "BabyAI-GoToLocal-v0[room_size=10][objects=4]");
  EXPECT_EQ(level.room_size, 10);
  EXPECT_EQ(objects(level), 4);
}

TEST(LevelEdit, IsFoundByNoOtherId) {
  for (const char* id :
       {"BabyAI-GoToLocal-v0[]", "BabyAI-GoToLocal-v0[objects=4", "BabyAI-GoToLocal-v0[objects=8]",
        "BabyAI-GoToLocal-v0[objects=4][room_size=10]",
        "BabyAI-GoToLocal-v0[room_size=10,objects=4]", "BabyAI-GoToLocal-v0[objects=04]",
        "BabyAI-GoToLocal-v0[rooms=4]", "[objects=4]", "Wordgaze-One-N8-K4-v0[objects=5]",
        "BabyAI-GoToLocal-v0[objects=99999999999]", "BabyAI-GoToLocal-v0[objects=40]"}) {
    EXPECT_THROW(find_level(id), std::invalid_argument) << id;
  }
}

TEST(LevelEdit, ShrinksARoomAndItsObjectsTogether) {
  const LevelSpec level = find_level("BabyAI-GoToLocal-v0");
  EXPECT_THROW(with_room(level, 5), std::invalid_argument);
  EXPECT_EQ(edited(level, {.room_size = 5, .objects = 2}).room_size, 5);
}

TEST(LevelEdit, RefusesWhatTheLevelCannotHave) {
  EXPECT_TRUE(contains(message_of<std::invalid_argument>(
                           [] { (void)with_objects(find_level("MiniGrid-MultiRoom-N6-v0"), 12); }),
                       "'MiniGrid-MultiRoom-N6-v0': objects = 12; expected none"));
  EXPECT_TRUE(contains(message_of<std::invalid_argument>(
                           [] { (void)with_room(find_level("MiniGrid-DistShift1-v0"), 12); }),
                       "room_size = 12; expected 9"));
  EXPECT_TRUE(contains(message_of<std::invalid_argument>(
                           [] { (void)with_objects(find_level("Wordgaze-One-N8-K4-v0"), 19); }),
                       "objects = 19; expected 1 to 18"));
}

}  // namespace
}  // namespace wordgaze::babyai
