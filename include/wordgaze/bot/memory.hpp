#pragma once
#include <optional>
#include <vector>

#include "wordgaze/bot/reach.hpp"
#include "wordgaze/bot/seen.hpp"
#include "wordgaze/bot/sought.hpp"
#include "wordgaze/bot/subgoal.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::bot {

/// What the bot carries from one action to the next.
struct Memory {
  Seen seen;
  Reach reach{};
  std::vector<Subgoal> plan{};    ///< a stack: the last one is the next to be reached
  std::vector<Sought> phrases{};  ///< two for each clause: its object, and "next to" what
  std::vector<Sought> keys{};     ///< as they stood when they came to be needed

  /// The situation that the last suggestion was made for.
  struct Before {
    grid::Position agent{};
    grid::ObjectId carried = grid::kNothing;
    grid::ObjectId ahead = grid::kNothing;
    grid::DoorState door = grid::DoorState::open;  ///< of the object ahead
    std::optional<grid::Action> suggested{};
  };
  Before before{};
};

}  // namespace wordgaze::bot
