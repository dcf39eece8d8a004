#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wordgaze/babyai/task.hpp"
#include "wordgaze/babyai/verifier.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::babyai {

/// How far an instruction is, in sub-tasks: things to be done with one object. A clause is one, but
/// "put A next to B" is two: to have A in hand, and to put it next to B. They are in the order of
/// the sentence, as Sentence::sub_task_of counts them.
class Progress {
 public:
  /// c_t: one 0/1 per sub-task, done so far. To have A in hand is undone when A is put elsewhere.
  std::span<const std::uint8_t> completion() const { return {completed_.data(), size_}; }
  /// One 0/1 per sub-task: not completed, and its turn has come.
  std::span<const std::uint8_t> enabled() const { return {enabled_.data(), size_}; }

  /// What a sub-task is about.
  const Description& object(std::size_t sub_task) const { return object_[sub_task]; }

  void add(const Description& object, bool completed, bool enabled) {
    object_[size_] = object;
    completed_[size_] = completed;
    enabled_[size_] = enabled;
    ++size_;
  }

 private:
  static constexpr std::size_t kMax = 2 * Instruction::kMaxClauses;
  std::array<Description, kMax> object_{};
  std::array<std::uint8_t, kMax> completed_{}, enabled_{};
  std::size_t size_ = 0;
};

/// Whether a description fits a thing by its looks; where it stands is not asked.
constexpr bool fits(const Description& description, grid::Type type, grid::Color color) {
  return description.type.value_or(type) == type && description.color.value_or(color) == color;
}

/// The cells with an object of an enabled sub-task, column by column; the agent's own where that is
/// in its hand.
std::vector<grid::Position> target_cells(const grid::World& world, const Progress& progress);

/// The progress of a task that a verifier watches in this world.
inline Progress progress(const Task& task, const grid::World& world, const Verifier& verifier) {
  Progress progress;
  const auto done = verifier.completion(), turn = verifier.declarable();
  for (std::size_t k = 0; k < done.size(); ++k) {
    const Clause& clause = task.instruction.clause[k];
    if (clause.verb != Verb::put_next) {
      progress.add(clause.object, done[k] != 0, turn[k] != 0);
      continue;
    }
    const bool held = world.carried != grid::kNothing &&
                      (task.meaning.object[k] & grid::only(world.carried)) != 0;
    progress.add(clause.object, done[k] || held, turn[k] && !held);
    progress.add(clause.next_to, done[k] != 0, turn[k] && held);
  }
  return progress;
}

}  // namespace wordgaze::babyai
