#pragma once
#include <array>
#include <optional>

#include "wordgaze/babyai/layout.hpp"

/// Stages that several generators share.
namespace wordgaze::babyai::generators {

/// The colors, `count` of them drawn to the front.
std::array<grid::Color, 6> draw_colors(Layout& layout, int count);

/// Doors on random sides of the middle room, of random colors; locked or not at random unless
/// given.
grid::ObjectRange add_doors(Layout& layout, int count, std::optional<bool> locked = {});

struct LockedRoom {
  grid::RoomIndex room;
  grid::ObjectId door;
};
/// Locks a random room and puts the key into a random one. As in the reference, which means to
/// avoid it, that may be the locked room itself. (docs/simulator.md, Levels)
LockedRoom lock_a_room(Layout& layout);

/// Distractors in each room, column by column, the locked one included.
void scatter_in_every_room(Layout& layout, int count);

/// The agent in any room but one.
void place_agent_outside(Layout& layout, grid::RoomIndex room);

/// Two rooms side by side: a box in the right one, a locked door between, and the key for it.
struct BoxBehindDoor {
  grid::ObjectId box, door;
};
BoxBehindDoor box_behind_locked_door(Layout& layout);

/// A ball in front of a door, over whatever lies there; `side` is where the door leads.
void block(Layout& layout, grid::ObjectId door, grid::Direction side, grid::Color color);

/// The key of a door, in a room.
void add_key(Layout& layout, grid::RoomIndex room, grid::ObjectId door);

/// Three columns of rooms around a corridor: an object behind a locked door at the right, the key
/// at the left. Returns the object.
grid::ObjectId object_off_corridor(Layout& layout);

}  // namespace wordgaze::babyai::generators
