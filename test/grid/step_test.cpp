#include "wordgaze/grid/step.hpp"

#include <gtest/gtest.h>

#include "grid/drawn_world.hpp"

namespace wordgaze::grid {
namespace {

TEST(Step, TurnsAndCountsSteps) {
  World world = drawn({"###", "#>#", "###"});
  step(world, Action::left);
  EXPECT_EQ(world.direction, Direction::up);
  step(world, Action::right);
  step(world, Action::right);
  EXPECT_EQ(world.direction, Direction::down);
  EXPECT_EQ(world.step_count, 3);
}

TEST(Step, WalksOnlyWhereNothingIsInTheWay) {
  for (const char front : {'#', 'K', 'B', 'X', 'c', 'l'}) {
    const std::string row = {'>', front};
    World world = drawn({row});
    step(world, Action::forward);
    EXPECT_EQ(world.agent, at(0, 0)) << front;
  }
  for (const char front : {'.', 'o', 'G', '~'}) {
    const std::string row = {'>', front};
    World world = drawn({row});
    const Events events = step(world, Action::forward);
    EXPECT_EQ(world.agent, at(1, 0)) << front;
    EXPECT_EQ(events.reached_goal, front == 'G');
    EXPECT_EQ(events.entered_lava, front == '~');
  }
}

TEST(Step, PicksUpOneObjectAndDropsItOnAnEmptyCell) {
  World world = drawn({".>B.K"});
  const ObjectId ball = world.grid[world.front()];
  step(world, Action::pickup);
  EXPECT_EQ(world.carried, ball);
  EXPECT_FALSE(world.stands(ball));
  EXPECT_EQ(world.object(ball).position, kNowhere);
  step(world, Action::forward);
  step(world, Action::forward);
  step(world, Action::pickup);  // the hands are full
  EXPECT_EQ(world.carried, ball);
  step(world, Action::drop);  // the key is in the way
  EXPECT_EQ(world.carried, ball);
  step(world, Action::left);
  step(world, Action::left);
  step(world, Action::drop);
  EXPECT_EQ(world.carried, kNothing);
  EXPECT_EQ(world.grid[at(2, 0)], ball);
  EXPECT_TRUE(world.stands(ball));
}

TEST(Step, DoesNotDropOnWhatCanBeWalkedOver) {
  World world = drawn({">~"});
  world.carried = world.add(Type::key, Color::red);
  step(world, Action::drop);
  EXPECT_NE(world.carried, kNothing);
}

TEST(Step, OpensAndClosesADoor) {
  World world = drawn({">c"});
  const ObjectId door = world.grid[world.front()];
  step(world, Action::toggle);
  EXPECT_EQ(world.object(door).state, DoorState::open);
  EXPECT_EQ(world.looks[door] & kBlocksSight, 0);
  step(world, Action::toggle);
  EXPECT_EQ(world.object(door).state, DoorState::closed);
  EXPECT_NE(world.looks[door] & kBlocksSight, 0);
}

TEST(Step, UnlocksADoorWithTheKeyOfItsColorAndKeepsTheKey) {
  World world = drawn({">l"});
  const ObjectId door = world.grid[world.front()];
  for (const auto& [type, color] : {std::pair{Type::ball, Color::red}, {Type::key, Color::blue}}) {
    world.carried = world.add(type, color);
    step(world, Action::toggle);
    EXPECT_EQ(world.object(door).state, DoorState::locked);
  }
  const ObjectId key = world.carried = world.add(Type::key, Color::red);
  step(world, Action::toggle);
  EXPECT_EQ(world.object(door).state, DoorState::open);
  EXPECT_EQ(world.carried, key);
  step(world, Action::toggle);
  EXPECT_EQ(world.object(door).state, DoorState::closed);  // not locked again
}

TEST(Step, OpensABoxIntoWhatItHolds) {
  World world = drawn({">X"});
  const ObjectId key = world.add(Type::key, Color::blue);
  world.objects[world.grid[world.front()]].contents = key;
  step(world, Action::toggle);
  EXPECT_EQ(world.grid[world.front()], key);
  EXPECT_TRUE(world.stands(key));
  World empty = drawn({">X"});
  step(empty, Action::toggle);
  EXPECT_EQ(empty.grid[empty.front()], kNothing);
}

TEST(World, IsAValue) {
  World world = drawn({">B."});
  const World snapshot = world;
  step(world, Action::pickup);
  EXPECT_EQ(snapshot.carried, kNothing);
  EXPECT_NE(snapshot.grid[at(1, 0)], kNothing);
}

TEST(World, RefusesMoreObjectsThanASetHolds) {
  World world;
  world.clear(9, 9);
  for (int k = 2; k < kMaxObjects; ++k) world.add(Type::ball, Color::red);
  EXPECT_THROW(world.add(Type::ball, Color::red), std::length_error);
}

TEST(Grid, ReadsAsWallAroundItsCells) {
  World world;
  world.clear(3, 2);
  for (int x = -Grid::kFrame; x < 3 + Grid::kFrame; ++x) {
    for (int y = -Grid::kFrame; y < 2 + Grid::kFrame; ++y) {
      const Position p = at(x, y);
      EXPECT_EQ(world.grid[p], world.grid.contains(p) ? kNothing : kWall) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace wordgaze::grid
