#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/babyai/parameters.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::grid {
struct World;
}

namespace wordgaze::babyai {

class Layout;
class Verifier;
struct Task;

/// How the `done` action takes part. (docs/simulator.md, Done modes)
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

/// Reward and end of a step.
struct Verdict {
  double reward = 0;  ///< a success is an end with a reward above 0
  bool terminated = false;
};

/// What there is to judge of a step.
struct Moment {
  const grid::World& world;  ///< after it
  const Task& task;
  const Verifier& verifier;  ///< what is done of the instruction
  grid::Action action;
  Verdict rule;  ///< what the level's rule says
};

/// Reward and end as a function, in place of what the rule says. It may be called by any thread and
/// keeps nothing: what it says depends on the moment alone.
using Judge = std::function<Verdict(const Moment&)>;

/// A generator draws one layout with its task; it throws grid::Rejected to start over. The headers
/// to write one: layout.hpp, stages.hpp, minigrid_stages.hpp and, to build on ours, generators.hpp.
using Generator = void (*)(Layout& layout);

/// One level: a row of data.
struct LevelSpec {
  std::string id;
  Generator generate = nullptr;
  int room_size = 8;  ///< cells along a side, walls included
  int rows = 3, columns = 3;
  int max_steps = 0;  ///< 0: navigations of the instruction times the area of all rooms
  DoneMode done_mode = DoneMode::off;
  Rule rule = Rule::instruction;
  bool see_through_walls = false;
  int actions = grid::kActions;  ///< the first so many
  bool strict = false;           ///< the wrong door or object is a failure
  Parameters parameters{};       ///< what its generator reads
  Judge judge{};                 ///< none: the rule says
};

/// Grids have at most so many cells along a side.
inline constexpr int kMaxGridSide = 1024;

/// Throws std::invalid_argument that says level, field, value and what is allowed: for numbers out
/// of range, parameters of another family than the generator's, more objects than fit.
void validate(const LevelSpec& level);

/// The level of an id: a built-in one, a registered one, Wordgaze-{One,Two,Three,Four}-N*-K*-v0, or
/// one of these edited (level_edit.hpp). Throws std::invalid_argument that offers the nearest known
/// ids, or that says what does not fit.
LevelSpec find_level(std::string_view id);

/// The levels of MiniGrid and BabyAI, in the order of docs/levels.md.
std::span<const LevelSpec> built_in_levels();

/// All ids that are known: the built-in ones, then the registered ones.
std::vector<std::string> level_ids();

/// Makes a level of one's own known by its id, as long as the program runs. States and traces refer
/// to levels by id: register before they are restored or replayed. May be called by any thread.
/// Throws std::invalid_argument for an id that is known already or that no id may look like, and
/// for what validate() refuses.
void register_level(LevelSpec level);

}  // namespace wordgaze::babyai
