#pragma once
#include <cstddef>
#include <limits>
#include <type_traits>
#include <variant>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/grid/room_grid.hpp"

namespace wordgaze::babyai {

/// The place of a kind in Parameters.
template <class P, std::size_t k = 0>
constexpr std::size_t kind_of() {
  if constexpr (std::is_same_v<std::variant_alternative_t<k, Parameters>, P>) {
    return k;
  } else {
    return kind_of<P, k + 1>();
  }
}
inline constexpr std::size_t kAnyKind = std::numeric_limits<std::size_t>::max();

/// What a generator needs of its level. Without an entry it takes what there is.
struct Needs {
  std::size_t kind = kind_of<std::monostate>();  ///< of its parameters
  int columns = 1, rows = 1;                     ///< at least
  int most_columns = grid::RoomGrid::kMaxRooms;
  int fewest = 1, most = grid::RoomGrid::kMaxRooms;  ///< rooms
  bool square = false;                               ///< as many columns as rows
  int smallest = 3, largest = kMaxGridSide;          ///< cells along a side of a room
  int least = 0;                                     ///< scattered objects
  int times = 1;                                     ///< so often it scatters that many
  bool together = false;                             ///< all of one time in one room
  int spacing = 0;                                   ///< cells that each keeps to itself
  int others = 0;                                    ///< objects besides
  int per_room = 0;                                  ///< objects in each room besides
  int doors = 0;                                     ///< not counting those that connect
  bool connects = false;                             ///< any wall between rooms may get a door
};

/// The needs of a built-in generator; of any other one, none.
Needs needs_of(Generator generate);

/// How many objects a level may scatter: [low, high], empty when its rooms hold too little.
struct ObjectLimits {
  int low = 0, high = 0;
};
ObjectLimits object_limits(const LevelSpec& level);

/// How many objects a world can still take when the level has placed what it always has.
int objects_left(const LevelSpec& level);

}  // namespace wordgaze::babyai
