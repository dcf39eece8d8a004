#pragma once
#include <map>
#include <string>

#include "wordgaze/babyai/instruction.hpp"

namespace wordgaze::evaluation {

/// Success by what the missions ask for.
struct Breakdown {
  struct Count {
    int episodes = 0, successes = 0;
    double success_rate() const {
      return episodes > 0 ? static_cast<double>(successes) / episodes : 0;
    }
  };
  using Counts = std::map<std::string, Count>;

  Counts by_verb;     ///< the verbs in the order of the sentence: "go to", "pick up, go to"
  Counts by_join;     ///< the words that join its clauses: "and, then"; "none" for one clause
  Counts by_clauses;  ///< "1" to "4"
  Counts by_object;   ///< "red ball"; an episode counts once for each that a clause names

  void add(const babyai::Instruction& instruction, bool success);
  void operator+=(const Breakdown& other);
};

}  // namespace wordgaze::evaluation
