#include "wordgaze/grid/room_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "grid/drawn_world.hpp"

namespace wordgaze::grid {
namespace {

TEST(RoomGrid, PutsADoorOnBothRoomsSides) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 5, 2, 1);
  const ObjectId door = rooms.add_door({0, 0}, Direction::right, Color::red, false);
  EXPECT_EQ(rooms.door({0, 0}, Direction::right), door);
  EXPECT_EQ(rooms.door({1, 0}, Direction::left), door);
  EXPECT_EQ(world.object(door).position.x, 4);
  EXPECT_FALSE(rooms.has_neighbor({0, 0}, Direction::up));
}

TEST(RoomGrid, SharesWallsBetweenRooms) {
  World world;
  core::Rng rng(1);
  const RoomGrid rooms(world, rng, 5, 2, 2);
  EXPECT_EQ(world.grid.width(), 9);
  EXPECT_TRUE(rooms.contains({0, 0}, at(4, 2)));
  EXPECT_TRUE(rooms.contains({1, 0}, at(4, 2)));
  EXPECT_EQ(rooms.room_of(at(4, 2)), (RoomIndex{1, 0}));
}

TEST(RoomGrid, ConnectsAllRooms) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    World world;
    core::Rng rng(seed);
    RoomGrid rooms(world, rng, 5, 3, 3);
    rooms.place_agent();
    rooms.connect_all();
    EXPECT_GE(world.objects.size(), 2u + 8u);  // nine rooms need eight doors
    EXPECT_TRUE(rooms.all_reachable()) << seed;
  }
}

TEST(RoomGrid, RefusesRoomsThatItCannotHold) {
  World world;
  core::Rng rng(1);
  constexpr auto kHostile = std::to_array<std::array<int, 3>>(
      {{2, 1, 1}, {5, 0, 1}, {5, 1, 0}, {5, 26, 1}, {5, 5, 6}, {5, 1 << 16, 1 << 16}});
  for (const auto& [size, columns, rows] : kHostile) {
    EXPECT_THROW(RoomGrid(world, rng, size, columns, rows), std::invalid_argument)
        << size << ' ' << columns << ' ' << rows;
  }
}

TEST(RoomGrid, HasNoRoomsOutside) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 5, 2, 1);
  EXPECT_THROW(rooms.door({2, 0}, Direction::left), std::out_of_range);
  EXPECT_THROW(rooms.door({0, -1}, Direction::left), std::out_of_range);
  EXPECT_THROW(rooms.add_door({0, 0}, Direction::up), std::out_of_range);
  EXPECT_EQ(world.objects.size(), 2u);  // no half a door
}

TEST(RoomGrid, GivesUpOnOneDoorMoreThanThereAreWalls) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 5, 2, 1);
  rooms.add_door({0, 0});
  EXPECT_THROW(rooms.add_door({0, 0}), GaveUp);
}

TEST(RoomGrid, GivesUpOnMoreKindsThanThereAre) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 12, 1, 1);
  EXPECT_EQ(rooms.scatter(std::nullopt, 18, true).size(), 18);
  EXPECT_THROW(rooms.scatter(std::nullopt, 1, true), GaveUp);
}

// Where a room is full, the reference draws 1001 cells and starts over.
TEST(RoomGrid, RejectsALayoutWithoutSpace) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 3, 1, 1);
  rooms.world.agent = kNowhere;
  rooms.place_in_room(world.add(Type::ball, Color::red), {});
  EXPECT_THROW(rooms.place_in_room(world.add(Type::ball, Color::blue), {}), Rejected);
}

TEST(RoomGrid, GivesUpWhereNoPlaceFacesFreeSpace) {
  World world;
  core::Rng rng(1);
  RoomGrid rooms(world, rng, 4, 1, 1);
  for (const Position p : {at(1, 1), at(2, 2)}) {
    world.put(world.add(Type::ball, Color::red), p);
  }
  // Both cells left face balls on two sides and walls on the others: those will do.
  rooms.place_agent();
  EXPECT_EQ(world.grid[world.front()], kWall);
  RoomGrid small(world, rng, 3, 3, 3);
  for (const Position p : {at(2, 3), at(4, 3), at(3, 2), at(3, 4)}) {
    world.put(world.add(Type::ball, Color::red), p);
  }
  EXPECT_THROW(small.place_agent(RoomIndex{1, 1}), GaveUp);
}

struct Reach {
  std::vector<std::string_view> rows;
  bool reachable;
};

TEST(RoomGrid, SeesWhichObjectsCanBeReached) {
  const std::vector<Reach> cases{
      {{"######", "#>..B#", "######"}, true},
      {{"######", "#>.KB#", "######"}, false},
      {{"######", "#>.lB#", "######"}, true},  // locked doors let it pass
      {{"######", "#>.#l#", "######"}, false},
  };
  for (const Reach& c : cases) {
    World world;
    core::Rng rng(1);
    const RoomGrid rooms(world, rng, 5, 1, 1);
    world = drawn(c.rows);
    EXPECT_EQ(rooms.all_reachable(), c.reachable) << c.rows[1];
  }
}

}  // namespace
}  // namespace wordgaze::grid
