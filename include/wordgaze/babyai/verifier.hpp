#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::babyai {

/// The verdict on an action. `none` is the reference's missing verdict in its done mode.
enum class Status : std::uint8_t { none, ongoing, success, failure };

/// Watches an instruction being carried out. It knows objects by identity, and where each one stood
/// when the episode began or something was last dropped: such a position may be out of date, as in
/// the reference. (docs/simulator.md, Verification)
class Verifier {
 public:
  /// Starts to watch. Nothing is completed.
  void begin(const grid::World& world, const Instruction& instruction, DoneMode mode);

  /// Looks up again where the objects stand; the reference does so at each drop.
  void refresh(const grid::World& world);

  /// Judges the action that led to this world.
  Status verify(const grid::World& world, const Task& task, grid::Action action);

  /// Counts a clause as done.
  void mark_completed(const Instruction& instruction, int clause);

  /// One 0/1 per clause: completed so far.
  std::span<const std::uint8_t> completion() const { return {completed_.data(), clauses_}; }
  /// One 0/1 per clause: not completed, and its turn has come.
  std::span<const std::uint8_t> declarable() const { return {declarable_.data(), clauses_}; }
  /// One 0/1 per clause: came true at the last action; for the done modes other than off.
  std::span<const std::uint8_t> matched() const { return {matched_.data(), clauses_}; }

  /// Where an object stood at the last look; none if it stood nowhere.
  std::optional<grid::Position> last_seen(const grid::World& world, grid::ObjectId id) const {
    if ((seen_ & grid::only(id)) == 0) return std::nullopt;
    return world.last_place(id);
  }

  /// Whether this can be what became of begin() in this world: what a restored one is asked.
  bool is_sound(const grid::World& world, const Instruction& instruction, DoneMode mode) const;

  /// Walks all members, to store or restore them.
  template <class Archive>
  void archive(Archive& archive) {
    archive(mode_, clauses_, completed_, declarable_, matched_, held_, seen_);
  }
  template <class Archive>
  void archive(Archive& archive) const {
    archive(mode_, clauses_, completed_, declarable_, matched_, held_, seen_);
  }

 private:
  using Part = Instruction::Part;

  Status verify_sequential(const grid::World&, const Task&, grid::Action);
  Status verify_in_order(const grid::World&, const Task&, grid::Action);
  bool any_succeeds(const grid::World&, const Task&, grid::Action, Part);
  Status verify_part(const grid::World&, const Task&, grid::Action, Part);
  Status verify_clause(const grid::World&, const Task&, grid::Action, int k);
  Status check(const grid::World&, const Task&, grid::Action, int k);

  bool stood_at(const grid::World&, const Meaning&, const Description&, grid::ObjectSet,
                grid::Position) const;
  bool completed(Part part) const;
  void update_turns(const Instruction& instruction);

  static constexpr int kMax = Instruction::kMaxClauses;
  DoneMode mode_ = DoneMode::off;
  std::uint8_t clauses_ = 0;
  std::array<std::uint8_t, kMax> completed_{}, declarable_{}, matched_{};
  std::array<grid::ObjectId, kMax> held_{};  // what was carried when the clause was last checked
  // The objects that stood in the grid at the last look. Until the next one, which is at a drop,
  // only one of them can be picked up: the world remembers where from.
  grid::ObjectSet seen_ = 0;
};

}  // namespace wordgaze::babyai
