#pragma once
#include <optional>
#include <stdexcept>
#include <variant>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/core/rng.hpp"
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

  /// What the level says to the generators of its family.
  template <class P>
  const P& parameters() const {
    return std::get<P>(level.parameters);
  }
  /// Scatters the level's Objects: in a room, or each in a random one.
  grid::ObjectRange scatter_objects(std::optional<grid::RoomIndex> room = {}) {
    const auto& wanted = parameters<Objects>();
    return scatter(room, wanted.count, wanted.unique);
  }

  /// The type and color of an object.
  Description describe(grid::ObjectId id) const {
    const grid::Object& object = world.object(id);
    return {.type = object.type, .color = object.color};
  }
  Description describe_type(grid::ObjectId id) const { return {.type = world.object(id).type}; }
  /// One of some objects. Throws std::out_of_range when there are none.
  grid::ObjectId pick_object(grid::ObjectRange objects) {
    if (objects.size() < 1) throw std::out_of_range("pick_object: no objects to pick from");
    return objects[rng.below(objects.size())];
  }

  /// The instruction of one clause.
  void ask(Verb verb, const Description& object) {
    task.instruction = single({.verb = verb, .object = object, .strict = level.strict});
  }
};

}  // namespace wordgaze::babyai
