#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/model/missions.hpp"
#include "wordgaze/policy/view.hpp"

namespace wordgaze::policy {

/// Follows how far a mission is by what an agent sees: c_t without an environment. Between two
/// views lies one action, which the first of them led to:
///
///     go to D               D is straight ahead
///     pick up D             the hand, empty before, holds D after a pickup
///     open D                D is ahead and open after a toggle
///     put D next to E       first half: D is in the hand. Second: it was, lies ahead after a drop,
///                           and E is beside it
///
/// Clauses have their turn in the order of the sentence. A view shows kinds, not identities: of two
/// red balls each is "the red ball". And it shows what is there now, where the simulator remembers
/// what stood there (docs/own-robot.md).
class Follower {
 public:
  /// When a clause counts as done: as soon as it comes true, or when the action `done` follows.
  enum class Counts : std::uint8_t { when_true, when_declared };

  /// Nothing is done yet. Throws std::invalid_argument for a description with a location ("on your
  /// left"): that is where the agent began, which no later view shows.
  Follower(const babyai::Instruction& instruction, Counts counts);

  /// The view now; `action` led to it, none to the first view.
  void see(const View& view, std::optional<grid::Action> action);

  /// c_t: 1 for sub-tasks that are done, in the order of the sentence.
  std::array<std::uint8_t, model::kMaxSubTasks> completion() const;

 private:
  using Clauses = std::array<bool, babyai::Instruction::kMaxClauses>;

  bool came_true(int clause, const View& view, grid::Action action);
  bool completed(babyai::Instruction::Part part) const;

  babyai::Instruction instruction_;
  Counts counts_;
  Clauses done_{}, matched_{};
  Cell hand_{};  // now
  // What was in the hand when the clause was looked at last.
  std::array<Cell, babyai::Instruction::kMaxClauses> held_{};
};

}  // namespace wordgaze::policy
