#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "wordgaze/model/missions.hpp"

namespace wordgaze::policy {

/// The missions of the lanes, each once, in slots that are counted: text is encoded once a mission.
/// Missions that nobody follows any more are remembered for a while and then make room, so that an
/// agent in service does not grow with the sentences that it has heard.
class MissionTable {
 public:
  /// Remembers up to as many missions that nobody follows.
  explicit MissionTable(int remembered) : remembered_(remembered) {}

  /// The slot of a mission, which is held until it is released as often.
  int acquire(const model::Mission& sentence) {
    auto& slots = missions_.sentences;
    const auto found = std::find(slots.begin(), slots.end(), sentence);
    int slot = static_cast<int>(found - slots.begin());
    if (found == slots.end()) {
      slot = new_slot(sentence);
      if (std::find(fresh_.begin(), fresh_.end(), slot) == fresh_.end()) fresh_.push_back(slot);
    }
    ++holders_[static_cast<std::size_t>(slot)];
    return slot;
  }
  void release(int slot) { --holders_[static_cast<std::size_t>(slot)]; }

  const model::Missions& missions() const { return missions_; }
  const model::Mission& operator[](int slot) const { return missions_[slot]; }

  /// Slots whose text is still to be encoded, in the order of their coming.
  const std::vector<int>& fresh() const { return fresh_; }
  void all_encoded() { fresh_.clear(); }

 private:
  int new_slot(const model::Mission& sentence) {
    const auto unused = std::count(holders_.begin(), holders_.end(), 0);
    if (unused <= remembered_) {
      holders_.push_back(0);
      return missions_.index_of(sentence);
    }
    const auto free = std::find(holders_.begin(), holders_.end(), 0) - holders_.begin();
    missions_.replace(static_cast<int>(free), sentence);
    return static_cast<int>(free);
  }

  int remembered_;
  model::Missions missions_;
  std::vector<int> holders_;  // of each slot
  std::vector<int> fresh_;
};

}  // namespace wordgaze::policy
