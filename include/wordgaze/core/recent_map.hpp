#pragma once
#include <cstddef>
#include <list>
#include <optional>
#include <unordered_map>
#include <utility>

#include "wordgaze/core/require.hpp"

namespace wordgaze {

/// Values by key, at most so many: what was not asked for the longest makes room for a new one.
template <class Key, class Value>
class RecentMap {
 public:
  using Entry = std::pair<const Key, Value>;

  /// Throws std::invalid_argument when there is room for none.
  explicit RecentMap(std::size_t capacity) : capacity_(capacity) {
    require(capacity > 0, "RecentMap: expected room for 1 or more; came {}", capacity);
  }
  RecentMap(const RecentMap&) = delete;  // places_ points into entries_
  RecentMap& operator=(const RecentMap&) = delete;

  std::size_t size() const { return places_.size(); }

  /// Null when the key is not there. The entry becomes the most recent; it stays where it is until
  /// it is erased or makes room.
  Value* find(const Key& key) {
    const auto place = places_.find(key);
    if (place == places_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, place->second);
    return &place->second->second;
  }

  /// Adds an entry, or puts another value into its place; gives back what made room for it.
  std::optional<Entry> put(const Key& key, Value value) {
    if (Value* known = find(key); known != nullptr) {
      *known = std::move(value);
      return std::nullopt;
    }
    entries_.emplace_front(key, std::move(value));
    places_.emplace(key, entries_.begin());
    if (size() <= capacity_) return std::nullopt;
    std::optional<Entry> oldest(std::move(entries_.back()));
    erase(oldest->first);
    return oldest;
  }

  void erase(const Key& key) {
    const auto place = places_.find(key);
    if (place == places_.end()) return;
    entries_.erase(place->second);
    places_.erase(place);
  }

 private:
  std::size_t capacity_;
  std::list<Entry> entries_;  // the most recent first
  std::unordered_map<Key, typename std::list<Entry>::iterator> places_;
};

}  // namespace wordgaze
