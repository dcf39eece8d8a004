#pragma once
#include <array>
#include <span>
#include <vector>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::babyai {

/// The verdict on an action.
enum class Status : std::uint8_t { none, ongoing, success, failure };

/// Watches an instruction being carried out. It knows objects by identity, and where each one stood
/// when the episode began or something was last dropped: a position may be out of date, as in the
/// reference. (spec 5 and 6)
class Verifier {
 public:
  /// Looks up what the descriptions mean in this world. False when one of them matches nothing.
  bool begin(const grid::World& world, const Instruction& instruction, DoneMode mode);

  /// Looks up again where the objects stand; the reference does so at each drop.
  void refresh(const grid::World& world);

  /// Judges the action that led to this world.
  Status verify(const grid::World& world, const Instruction& instruction, grid::Action action);

  void mark_completed(const Instruction& instruction, int clause);

  std::span<const std::uint8_t> completion() const { return {completed_.data(), clauses_}; }
  std::span<const std::uint8_t> declarable() const { return {declarable_.data(), clauses_}; }

 private:
  static constexpr int kMax = Instruction::kMaxClauses;
  std::size_t clauses_ = 0;
  std::array<std::uint8_t, kMax> completed_{}, declarable_{};
};

}  // namespace wordgaze::babyai
