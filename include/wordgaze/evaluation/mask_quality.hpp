#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/evaluation/mean.hpp"

namespace wordgaze::evaluation {

/// How well the mask alpha > 0.5 agrees with the true one over the words of clauses; words that
/// join clauses are left out, they are always bright. "Positive" is a bright word.
struct MaskQuality {
  std::int64_t true_positive = 0, false_positive = 0, false_negative = 0, true_negative = 0;
  Mean bright, dark;  ///< alpha of the words that the true mask keeps, and of those it silences

  /// Adds a decision. Returns whether all words agree.
  bool add(std::span<const float> alpha, const babyai::Sentence& sentence,
           std::uint16_t bright_sub_tasks);

  double precision() const;
  double recall() const;
  double f1() const;
};

/// How many steps after c_t has changed the mask agrees with the true one.
class MaskDelay {
 public:
  /// Adds a decision of a lane, in order. `completed` are the sub-tasks that are done, as bits.
  void add(std::size_t lane, bool begins, std::uint16_t completed, bool agrees);

  std::int64_t changes() const { return changes_; }
  /// Changes at which the mask agreed at once.
  std::int64_t at_once() const { return at_once_; }
  /// Mean steps over the changes that it ever followed; it had not followed the others when c_t
  /// changed again or the episode ended.
  const Mean& steps() const { return steps_; }

 private:
  struct Lane {
    std::uint16_t completed = 0;
    int waiting = -1;  // steps since the change; -1: nothing to wait for
  };
  std::vector<Lane> lanes_;
  std::int64_t changes_ = 0, at_once_ = 0;
  Mean steps_;
};

}  // namespace wordgaze::evaluation
