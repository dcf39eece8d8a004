#pragma once
#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/progress.hpp"
#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/babyai/verifier.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::env {

/// What a step brought. Terminated (the task ended it) and truncated (time is up) stay apart, and
/// may both be true.
struct Transition {
  double reward = 0;
  bool terminated = false;
  bool truncated = false;
};

/// One environment, byte for byte the reference's: the same seed and actions give the same worlds,
/// views and rewards. A value: a copy goes on identically. Any call that throws leaves the
/// environment as it was.
class Environment {
 public:
  /// Throws std::invalid_argument for an id that is not known or a level that is not valid
  /// (babyai::validate).
  explicit Environment(std::string_view id);
  explicit Environment(const babyai::LevelSpec& spec);

  /// Starts an episode from a seed. Throws std::runtime_error that names id and seed when no layout
  /// is found within a bounded number of tries (the reference searches for ever).
  void reset(std::uint64_t seed);
  void reset(const core::Seed& seed);  ///< seeds of any size
  /// Throws std::invalid_argument for a negative seed.
  template <std::signed_integral Signed>
  void reset(Signed seed) {
    require(seed >= 0, "environment '{}': seed {}; expected a non-negative integer", id(), seed);
    reset(static_cast<std::uint64_t>(seed));
  }
  void reset(std::floating_point auto seed) = delete;
  /// Starts an episode where the random stream is; from an unpredictable seed when there is none.
  void reset();
  /// Starts an episode where another random stream is, and goes on with that one.
  void reset(const core::Rng& rng);

  /// Throws std::invalid_argument for an action out of range, std::logic_error before the first
  /// reset.
  Transition step(grid::Action action);

  /// Writes the agent's view.
  void observe(grid::ImageView image) const;
  /// Where the agent looks: 0 right, 1 down, 2 left, 3 up.
  int direction() const { return static_cast<int>(world_.direction); }

  int max_steps() const { return task_.max_steps; }
  int step_count() const { return world_.step_count; }
  int num_actions() const { return spec_->actions; }
  const std::string& id() const { return spec_->id; }
  const babyai::LevelSpec& spec() const { return *spec_; }
  const grid::World& world() const { return world_; }
  const core::Rng& rng() const { return rng_; }
  /// Goes on with another random stream, for whoever draws from it between the steps.
  void set_rng(const core::Rng& rng) { rng_ = rng; }

  const babyai::Instruction& instruction() const { return task_.instruction; }
  const babyai::Meaning& meaning() const { return task_.meaning; }
  const babyai::Sentence& sentence() const { return task_.sentence; }
  std::string mission() const { return babyai::text(task_.sentence); }

  const babyai::Verifier& verifier() const { return verifier_; }

  /// The vector c_t and whose turn it is, in sub-tasks: what an agent is told.
  babyai::Progress progress() const { return babyai::progress(task_, world_, verifier_); }
  /// One 0/1 per clause, in the order of the sentence: completed so far. Empty in MiniGrid's own
  /// levels, which have no clauses.
  std::span<const std::uint8_t> completion() const { return verifier_.completion(); }
  /// One 0/1 per clause: not completed, and its turn has come.
  std::span<const std::uint8_t> declarable() const { return verifier_.declarable(); }
  /// One 0/1 per clause: came true at the last action, where the done mode waits for it to be
  /// declared.
  std::span<const std::uint8_t> matched() const { return verifier_.matched(); }

  /// Training tools, outside what the reference does:

  /// Gives this world another instruction: sentence, completion and step limit anew. Throws
  /// std::invalid_argument when a description matches nothing, std::length_error when the sentence
  /// has more than kMaxMissionWords.
  void set_instruction(const babyai::Instruction& instruction);
  /// Starts with a clause already done. Throws std::invalid_argument unless it is declarable and
  /// another one is left.
  void mark_completed(int clause);
  /// Puts an object that stands in the grid into an empty cell of it. Throws std::invalid_argument
  /// for any other object or cell.
  void move_object(grid::ObjectId id, grid::Position to);
  /// Starts with an object in hand. Throws std::invalid_argument unless it stands in the grid, can
  /// be carried, and nothing else is.
  void take_object(grid::ObjectId id);

  /// The complete state, random stream included.
  std::vector<std::uint8_t> serialize() const;
  /// Takes over a state of an environment of the same id. Throws std::runtime_error for bytes that
  /// are not one.
  void restore(std::span<const std::uint8_t> bytes);

 private:
  template <class Archive, class Env>
  static void archive(Archive& archive, Env& env);
  [[nodiscard]] bool start(core::Rng rng);
  Transition step_as_ruled(grid::Action action);
  Transition step_as_judged(grid::Action action);
  [[noreturn]] void fail_to_start(const std::string& seed) const;

  std::shared_ptr<const babyai::LevelSpec> spec_;
  core::Rng rng_;
  bool seeded_ = false;
  grid::World world_;
  babyai::Task task_;
  babyai::Verifier verifier_;
};

}  // namespace wordgaze::env
