#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/babyai/instruction.hpp"

namespace wordgaze::babyai {

class Layout;

/// How the `done` action takes part. (spec 6 and 11)
enum class DoneMode : std::uint8_t {
  off,         ///< a clause counts when it comes true; done does nothing
  exact,       ///< BABYAI_DONE_ACTIONS of the reference, with actions passed as numbers
  exact_enum,  ///< the same with actions passed as enum members, which "and" treats differently
  sequential,  ///< our own: each clause is declared by its own done, in its order
};

/// What ends an episode besides time, the goal square and lava.
enum class Rule : std::uint8_t {
  instruction,        ///< BabyAI: the verifier of the instruction
  goal,               ///< nothing more
  fetch,              ///< picking something up: right if it is of the target's type and color
  reach_and_declare,  ///< done beside the target's place; toggle fails
  put_near,           ///< dropping: right if it is the target object, near the place
  pick_up_target,     ///< picking the target up
  open_target,        ///< opening the target
  red_then_blue,      ///< opening both targets in order
  memory,             ///< standing on the place; standing on the trap fails. Pickup toggles
  dynamic_obstacles,  ///< walking into something fails; the target and all behind it move about
};

/// Shapes of the instructions that LevelGen draws.
enum class Form : std::uint8_t { clause, both, ordered };

inline constexpr std::array kAllVerbs{Verb::go_to, Verb::pickup, Verb::open, Verb::put_next};
inline constexpr std::array kAllForms{Form::clause, Form::both, Form::ordered};

/// What BabyAI's LevelGen may ask for. The lists are not owned; a single entry is not drawn.
/// (spec 7)
struct MissionSpec {
  double locked_room = 0.5;     ///< probability that one room is locked
  bool locations = true;        ///< "on your left"
  bool unblocking = true;       ///< objects may have to be moved out of the way
  bool implicit_unlock = true;  ///< the target may be in the locked room
  std::span<const Verb> verbs = kAllVerbs;
  std::span<const Form> forms = kAllForms;
};

/// MiniGrid's ObstructedMaze. (spec 9)
struct MazeSpec {
  int agent_column = 1, agent_row = 1;
  bool key_in_box = true, blocked = true;
  int quarters = 4;        ///< sides of the middle room with rooms to search
  bool keys_last = false;  ///< placed behind the balls, which then cannot replace them (v1)
};

/// A generator draws one layout with its instruction; it throws Rejected to start over.
using Generator = void (*)(Layout& layout);

/// One level: a row of data. What a generator does not use is left at its default.
struct LevelSpec {
  std::string id;
  Generator generate = nullptr;
  int room_size = 8;  ///< cells along a side, walls included
  int rows = 3, columns = 3;
  int max_steps = 0;  ///< 0: navigations of the instruction times the area of all rooms
  DoneMode done_mode = DoneMode::off;
  Rule rule = Rule::instruction;
  bool see_through_walls = false;
  int actions = 7;

  int objects = 0;      ///< how many the generator scatters
  bool unique = false;  ///< no two of them of the same type and color
  int clauses = 1;      ///< of Wordgaze's tasks
  bool strict = false;  ///< the wrong door or object is a failure
  MissionSpec missions{};
  MazeSpec maze{};
};

/// The level of an id. Throws std::invalid_argument that offers the nearest known ids, or that says
/// what does not fit.
LevelSpec find_level(std::string_view id);

/// All ids of MiniGrid and BabyAI that are known, in the order of docs/levels.md.
std::vector<std::string> level_ids();

}  // namespace wordgaze::babyai
