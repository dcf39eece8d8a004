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

  static constexpr grid::RoomIndex kMiddle{1, 1};

  const LevelSpec& level;
  Task& task;

  /// The type and color of an object.
  Description describe(grid::ObjectId id) const {
    const grid::Object& object = world.object(id);
    return {.type = object.type, .color = object.color};
  }
  Description describe_type(grid::ObjectId id) const { return {.type = world.object(id).type}; }
  grid::ObjectId pick_object(grid::ObjectRange objects) {
    return objects[rng.below(objects.size())];
  }

  /// The instruction of one clause.
  void ask(Verb verb, const Description& object) {
    task.instruction = single({.verb = verb, .object = object, .strict = level.strict});
  }
};

}  // namespace wordgaze::babyai
