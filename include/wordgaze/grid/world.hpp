#pragma once
#include <array>
#include <vector>

#include "wordgaze/grid/grid.hpp"
#include "wordgaze/grid/look.hpp"

namespace wordgaze::grid {

/// Everything there is: the grid, its objects and the agent. A value: a copy is a snapshot.
struct World {
  Grid grid;
  std::vector<Object> objects;            ///< by ObjectId; the first two are "nothing" and the wall
  std::array<Look, kMaxObjects> looks{};  ///< by ObjectId; kept up to date by add, paint, set_door
  bool see_through_walls = false;         ///< the agent sees all of its view
  Position agent = kNowhere;
  Direction direction = Direction::right;
  ObjectId carried = kNothing;
  Position carried_from = kNowhere;  ///< where the carried object stood
  int step_count = 0;
  int room_size = 0;  ///< cells along a side of a room, walls included; 0: the grid is one room

  /// An empty grid without objects and without agent.
  void clear(int width, int height);

  /// A new object that stands nowhere yet. Throws std::length_error beyond kMaxObjects.
  ObjectId add(Type type, Color color, DoorState state = DoorState::open);
  /// Puts an object into a cell, over what may be there.
  void put(ObjectId id, Position p);
  void set_door(ObjectId id, DoorState state);
  void paint(ObjectId id, Color color);

  const Object& object(ObjectId id) const { return objects[id]; }
  const Object& object_at(Position p) const { return objects[grid[p]]; }
  Position front() const { return agent + forward(direction); }
  /// Where an object stood last, also while it is carried.
  Position last_place(ObjectId id) const {
    return id == carried ? carried_from : objects[id].position;
  }
  /// Whether the object stands in the grid now: not carried, not in a box, not gone.
  bool stands(ObjectId id) const {
    return id > kWall && objects[id].position != kNowhere && grid[objects[id].position] == id;
  }
};

}  // namespace wordgaze::grid
