#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "wordgaze/grid/builder.hpp"

namespace wordgaze::grid {

/// A room by column and row.
struct RoomIndex {
  int column = 0, row = 0;
  bool operator==(const RoomIndex&) const = default;
};

/// Objects that were created one after the other.
struct ObjectRange {
  ObjectId first = kNothing;
  int count = 0;

  int size() const { return count; }
  ObjectId operator[](int k) const { return static_cast<ObjectId>(first + k); }
};

/// Builds a grid of square rooms that share their walls, as MiniGrid's RoomGrid. A room that the
/// grid does not have throws std::out_of_range. (docs/simulator.md, Levels)
class RoomGrid : public Builder {
 public:
  static constexpr int kMaxRooms = 25;

  /// Throws std::invalid_argument for rooms below 3 x 3 cells, none, or more than kMaxRooms.
  RoomGrid(World& world, core::Rng& rng, int room_size, int columns, int rows);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  RoomIndex random_room();
  /// A shared wall belongs to the room at its right or below.
  RoomIndex room_of(Position p) const;
  Position corner(RoomIndex room) const {
    return at(room.column * (size_ - 1), room.row * (size_ - 1));
  }
  /// Shared walls belong to both rooms.
  bool contains(RoomIndex room, Position p) const;
  bool has_neighbor(RoomIndex room, Direction side) const;
  /// The door at a side; kWall where the wall was removed, kNothing where it is whole.
  ObjectId door(RoomIndex room, Direction side) const { return at_room(room).doors[int(side)]; }

  /// Puts an object into a room, not beside the agent (who stands in the middle of the middle room
  /// until it is placed).
  void place_in_room(ObjectId id, RoomIndex room);
  /// Draws what is not given: first the type, then the color.
  ObjectId add_object(RoomIndex room, std::optional<Type> type = {},
                      std::optional<Color> color = {});
  /// Adds `count` objects, in one room or each in a random one; `unique`: unlike all that are
  /// there.
  ObjectRange scatter(std::optional<RoomIndex> room, int count, bool unique);
  /// Draws what is not given: side, color, locked.
  ObjectId add_door(RoomIndex room, std::optional<Direction> side = {},
                    std::optional<Color> color = {}, std::optional<bool> locked = {});
  void remove_wall(RoomIndex room, Direction side);
  /// In a room, or in a random one; not facing an object. Throws GaveUp where the reference would
  /// try for ever.
  void place_agent(std::optional<RoomIndex> room = {});
  /// Adds doors until all rooms can be reached.
  void connect_all(std::span<const Color> colors = kColorsToDraw);

  /// Whether the agent could get beside every object; doors of any state let it pass.
  bool all_reachable() const;
  void require_reachable() const {
    if (!all_reachable()) throw Rejected{};
  }

 private:
  struct Room {
    std::array<ObjectId, 4> doors{};
    std::array<Position, 4> door_positions{};
    bool locked = false;
  };
  std::size_t index(RoomIndex room) const;
  Room& at_room(RoomIndex room) { return rooms_[index(room)]; }
  const Room& at_room(RoomIndex room) const { return rooms_[index(room)]; }
  void connect(RoomIndex room, Direction side, ObjectId by);
  bool all_connected() const;

  int size_, columns_, rows_;
  std::array<Room, kMaxRooms> rooms_;
  std::uint32_t kinds_ = 0;  // the types and colors of all objects placed in rooms
};

}  // namespace wordgaze::grid
