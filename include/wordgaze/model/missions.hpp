#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wordgaze/babyai/sentence.hpp"

namespace wordgaze::model {

/// The most sub-tasks that a completion vector tells of.
inline constexpr std::size_t kMaxSubTasks = 16;

/// A mission, and what is done of it where the reading of the text depends on it (Reader::scan);
/// else nothing.
struct Mission : babyai::Sentence {
  std::array<std::uint8_t, kMaxSubTasks> done{};
  bool operator==(const Mission&) const = default;
};

/// The distinct missions of a batch. Missions repeat and do not change within an episode, so text
/// is encoded once a mission and gathered by index.
struct Missions {
  std::vector<Mission> sentences;
  int longest = 0;  ///< words

  int size() const { return static_cast<int>(sentences.size()); }
  void clear() {
    sentences.clear();
    longest = 0;
  }
  /// Index of the sentence, added if it is new.
  int index_of(const Mission& sentence) {
    const auto found = std::find(sentences.begin(), sentences.end(), sentence);
    if (found != sentences.end()) return static_cast<int>(found - sentences.begin());
    sentences.push_back(sentence);
    longest = std::max(longest, sentence.length);
    return size() - 1;
  }
  /// Puts another sentence into a place.
  void replace(int i, const Mission& sentence) {
    sentences[static_cast<std::size_t>(i)] = sentence;
    longest = 0;
    for (const auto& s : sentences) longest = std::max(longest, s.length);
  }
  const Mission& operator[](int i) const {
    assert(i >= 0 && i < size());
    return sentences[static_cast<std::size_t>(i)];
  }
};

}  // namespace wordgaze::model
