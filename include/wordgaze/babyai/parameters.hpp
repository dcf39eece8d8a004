#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/position.hpp"

/// What a level tells the generators of its family, besides its rooms.
namespace wordgaze::babyai {

/// Objects scattered about; a level may have others of its own besides.
struct Objects {
  int count = 0;
  bool unique = false;  ///< no two of them of the same type and color
};

/// Wordgaze's tasks in one room: objects of different kinds, as many of them targets as there are
/// clauses.
struct OneRoomTask {
  int objects = 4;
  int clauses = 1;  ///< 1 to 8
};

/// Shapes of the instructions that LevelGen draws.
enum class Form : std::uint8_t { clause, both, ordered };

/// What BabyAI's LevelGen may ask for; a list with one entry is not drawn from.
/// (docs/simulator.md, Levels)
struct Missions {
  int objects = 18;
  double locked_room = 0.5;     ///< probability that one room is locked
  bool locations = true;        ///< "on your left"
  bool unblocking = true;       ///< objects may have to be moved out of the way
  bool implicit_unlock = true;  ///< the target may be in the locked room
  std::vector<Verb> verbs{Verb::go_to, Verb::pickup, Verb::open, Verb::put_next};
  std::vector<Form> forms{Form::clause, Form::both, Form::ordered};
};

/// BabyAI's OpenDoorsOrder: doors of the middle room.
struct Doors {
  int count = 2;  ///< 2 to 4
};

/// MiniGrid's LavaCrossing and SimpleCrossing: rivers across the room, each with one crossing.
struct Crossings {
  int rivers = 1;
};

/// MiniGrid's MultiRoom: a chain of rooms in a grid of 25 x 25 cells.
struct MultiRoom {
  static constexpr int kGridSide = 25, kMaxRooms = 6;

  int rooms = 2;    ///< 1 to 6
  int largest = 4;  ///< cells along a side of a room, walls included
};

/// MiniGrid's Dynamic-Obstacles: balls that move about.
struct Obstacles {
  int count = 1;
};

/// MiniGrid's ObstructedMaze-1D*: a locked door.
struct ObstructedDoor {
  bool key_in_box = true;
  bool blocked = true;  ///< by a ball
};

/// MiniGrid's ObstructedMaze-2D*, -1Q, -2Q and -Full. (docs/simulator.md, Levels)
struct Maze {
  int agent_column = 1, agent_row = 1;
  ObstructedDoor doors{};
  int quarters = 4;        ///< sides of the middle room with rooms to search
  bool keys_last = false;  ///< placed behind the balls, which then cannot replace them (v1)
};

/// A level of data, as level_text.hpp makes one: a map or the level's rooms, objects that are
/// placed at random, and missions of which one is drawn.
struct Plan {
  /// What is placed; what is not given is drawn.
  struct Thing {
    std::optional<grid::Type> type{};    ///< drawn: key, ball or box
    std::optional<grid::Color> color{};  ///< doors, keys, balls, boxes and floors have one
    grid::DoorState state = grid::DoorState::closed;  ///< of doors
  };
  struct Cell {
    grid::Position place{};
    Thing thing{};
  };
  /// An instruction with gaps.
  struct Mission {
    struct Gap {
      int clause = 0;
      bool next_to = false;
    };
    std::string text{};  ///< as it was written
    Instruction instruction{};
    std::vector<Gap> gaps{};  ///< descriptions to fill with things that are there, all different
  };

  int width = 0, height = 0;              ///< of the map; 0: the level's rooms, joined by doors
  std::vector<Cell> cells{};              ///< of the map, but the empty ones
  std::optional<grid::Position> agent{};  ///< else anywhere
  std::optional<grid::Direction> direction{};  ///< else any
  std::vector<Thing> objects{};
  bool distinct = false;            ///< no two keys, balls and boxes of the same type and color
  std::vector<Mission> missions{};  ///< none: to reach the goal

  bool is_map() const { return width > 0; }
};

/// One kind for each family of generators; none for those that ask for nothing.
using Parameters = std::variant<std::monostate, Objects, OneRoomTask, Missions, Doors, Crossings,
                                MultiRoom, Obstacles, ObstructedDoor, Maze, Plan>;

}  // namespace wordgaze::babyai
