#pragma once
#include <cstdint>
#include <optional>
#include <variant>

#include "wordgaze/grid/object.hpp"

/// The steps of a plan. The bot keeps them on a stack, the next one on top.
namespace wordgaze::bot {

/// Close the open door ahead.
struct Close {};

/// Open the door ahead.
struct Open {
  /// What becomes of the key of a locked door.
  enum class Key : std::uint8_t { undecided, drop, keep };
  Key key = Key::undecided;
};

/// Drop what is carried into the cell ahead.
struct Drop {};

/// Pick up what is ahead.
struct PickUp {};

/// A cell; none when there was no cell that would do, which the bot notices only on its way.
struct Place {
  std::optional<grid::Position> position;
};
/// A certain door.
struct Door {
  grid::ObjectId id;
};
/// The closest of the objects that a phrase means, by its index in the bot's memory.
struct Meant {
  int phrase;
};
/// The closest of some keys, by their index in the bot's memory.
struct Key {
  int keys;
};
using Target = std::variant<Place, Door, Meant, Key>;

/// Go and face a target.
struct GoTo {
  enum class Purpose : std::uint8_t {
    face,      ///< nothing more
    open,      ///< to open the door: fetch its key first if that takes one
    put_next,  ///< to drop something beside the target: face a cell beside it
    explore,   ///< to see more: given up as soon as something new may have come into view
  };
  Target target;
  Purpose purpose = Purpose::face;
};

/// Find out more of the world.
struct Explore {};

using Subgoal = std::variant<Close, Open, Drop, PickUp, GoTo, Explore>;

}  // namespace wordgaze::bot
