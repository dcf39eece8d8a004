#pragma once
#include <array>
#include <cstdint>

#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/position.hpp"

namespace wordgaze::grid {

/// Index of an object in its world's table; a cell of the grid is one such byte.
using ObjectId = std::uint8_t;
inline constexpr ObjectId kNothing = 0;  ///< an empty cell, empty hands
inline constexpr ObjectId kWall = 1;     ///< all walls are one object
inline constexpr int kMaxObjects = 64;   ///< so that a set of objects is one 64-bit word

/// A set of objects: bit k is object k.
using ObjectSet = std::uint64_t;
constexpr ObjectSet only(ObjectId id) { return ObjectSet{1} << id; }

struct Object {
  // The first three bytes are what the agent sees of the cell, in this order.
  Type type = Type::empty;
  Color color = Color::red;
  DoorState state = DoorState::open;  ///< doors only, else 0
  ObjectId contents = kNothing;       ///< boxes only: what is inside, invisible
  /// Where it stood last. It stands there now iff the grid holds its id there; kNowhere while
  /// carried.
  Position position = kNowhere;
};
static_assert(sizeof(Object) == 8);

/// What is seen of an object: type, color, door state.
constexpr std::array<std::uint8_t, 3> code_of(const Object& o) {
  return {static_cast<std::uint8_t>(o.type), static_cast<std::uint8_t>(o.color),
          static_cast<std::uint8_t>(o.state)};
}

constexpr bool can_be_carried(const Object& o) {
  return o.type == Type::key || o.type == Type::ball || o.type == Type::box;
}
constexpr bool can_be_entered(const Object& o) {
  return o.type == Type::empty || o.type == Type::goal || o.type == Type::floor ||
         o.type == Type::lava || (o.type == Type::door && o.state == DoorState::open);
}
constexpr bool blocks_sight(const Object& o) {
  return o.type == Type::wall || (o.type == Type::door && o.state != DoorState::open);
}

}  // namespace wordgaze::grid
