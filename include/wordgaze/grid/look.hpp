#pragma once
#include <array>
#include <cstdint>

#include "wordgaze/grid/object.hpp"

namespace wordgaze::grid {

/// All that is seen of an object, in one byte: its kind in bits 0 to 3, its color in bits 4 to 6,
/// and in bit 7 whether it blocks sight. A kind is a type, but that closed and locked doors are
/// kinds of their own. 0 is a cell that is not seen.
using Look = std::uint8_t;

inline constexpr int kKinds = 16;       ///< the last ones are not in use
inline constexpr int kClosedDoor = 11;  ///< one above the types, and one below the locked door
inline constexpr Look kBlocksSight = 0x80;

/// Type and door state by kind.
inline constexpr std::array<Type, kKinds> kKindTypes{
    Type::unseen, Type::empty, Type::wall, Type::floor, Type::door, Type::key, Type::ball,
    Type::box,    Type::goal,  Type::lava, Type::agent, Type::door, Type::door};
inline constexpr std::array<DoorState, kKinds> kKindStates = [] {
  std::array<DoorState, kKinds> states{};
  states[kClosedDoor] = DoorState::closed;
  states[kClosedDoor + 1] = DoorState::locked;
  return states;
}();

constexpr Look look_of(const Object& o) {
  const int kind = o.state == DoorState::open ? static_cast<int>(o.type)
                                              : kClosedDoor + static_cast<int>(o.state) - 1;
  return static_cast<Look>(kind | static_cast<int>(o.color) << 4 |
                           (blocks_sight(o) ? kBlocksSight : 0));
}

}  // namespace wordgaze::grid
