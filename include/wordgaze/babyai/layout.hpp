#pragma once
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/grid/room_grid.hpp"

namespace wordgaze::babyai {

/// What a generator works on: the rooms of a level, and the task that it writes.
class Layout : public grid::RoomGrid {
 public:
  Layout(const LevelSpec& l, grid::World& w, core::Rng& r, Task& t)
      : RoomGrid(w, r, l.room_size, l.columns, l.rows), level(l), task(t) {}

  const LevelSpec& level;
  Task& task;

  /// The type and color of an object.
  Description describe(grid::ObjectId id) const {
    const grid::Object& object = world.object(id);
    return {.type = object.type, .color = object.color};
  }
  grid::ObjectId pick_object(grid::ObjectRange objects) {
    return objects[rng.below(objects.size())];
  }
};

}  // namespace wordgaze::babyai
