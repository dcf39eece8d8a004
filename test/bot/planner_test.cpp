#include "bot/planner.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "grid/drawn_world.hpp"
#include "wordgaze/grid/step.hpp"

// Rules in worlds drawn for them: the recorded episodes (bot_test.cpp) reach them rarely or never.
namespace wordgaze::bot {
namespace {

using grid::Action;
using grid::at;
using grid::ObjectId;
using grid::Type;

struct Scene {
  grid::World world;
  Memory memory;

  Scene(const std::vector<std::string_view>& rows, std::vector<Subgoal> plan)
      : world(grid::drawn(rows)),
        memory{.seen = {world.grid.width(), world.grid.height()}, .plan = std::move(plan)} {}

  /// Does what the bot says until nothing is left to do.
  void play() {
    std::optional<Action> taken;
    for (int n = 0; n < 100; ++n) {
      taken = Planner(world, memory).next_action(taken);
      if (taken == Action::done) return;
      step(world, *taken);
    }
    FAIL() << "it goes on for ever";
  }
  ObjectId the(Type type) const {
    for (ObjectId id = 2; id < world.objects.size(); ++id) {
      if (world.object(id).type == type) return id;
    }
    return grid::kNothing;
  }
};

TEST(Planner, FetchesTheKeyWithWhatItCarriesLaidAside) {
  Scene scene({"########", "#K...B.#", "#.....>l", "########"}, {Open{}});
  grid::take(scene.world, at(5, 1));
  const ObjectId ball = scene.the(Type::ball);
  ASSERT_EQ(scene.world.carried, ball);
  scene.play();
  EXPECT_EQ(scene.world.object(scene.the(Type::door)).state, grid::DoorState::open);
  EXPECT_EQ(scene.world.carried, ball);
}

TEST(Planner, FetchesTheKeyWithEmptyHands) {
  Scene scene({"########", "#K.....#", "#.....>l", "########"}, {Open{}});
  scene.play();
  EXPECT_EQ(scene.world.object(scene.the(Type::door)).state, grid::DoorState::open);
  EXPECT_EQ(scene.world.carried, grid::kNothing);
}

TEST(Planner, OpensADoorOnTheWayThatItCannotSeeBehind) {
  Scene scene({"#########", "#>..c...#", "#########"}, {GoTo{Place{at(7, 1)}}});
  scene.play();
  EXPECT_EQ(scene.world.front(), at(7, 1));
}

TEST(Planner, ClosesADoorBeforeItOpensIt) {
  Scene scene({"####", "#.>o", "####"}, {Open{}});
  scene.play();
  EXPECT_EQ(scene.world.object(scene.the(Type::door)).state, grid::DoorState::open);
  EXPECT_EQ(scene.world.step_count, 2);
}

TEST(Planner, GivesUpWhereThereIsNoWay) {
  Scene scene({"######", "#>.#.#", "######"}, {GoTo{Place{at(4, 1)}}});
  EXPECT_THROW(scene.play(), GivesUp);
}

TEST(Planner, GivesUpWhereNothingCanBePutDown) {
  Scene scene({"#####", "#>Bb#", "#####"}, {GoTo{Place{at(3, 1)}}});
  EXPECT_THROW(scene.play(), GivesUp);
}

TEST(Planner, HasNothingToBringBackAfterADone) {
  Scene scene({"####", "#.>c", "####"}, {Open{}});
  EXPECT_EQ(Planner(scene.world, scene.memory).next_action(std::nullopt), Action::toggle);
  EXPECT_EQ(Planner(scene.world, scene.memory).next_action(Action::done), Action::toggle);
}

}  // namespace
}  // namespace wordgaze::bot
