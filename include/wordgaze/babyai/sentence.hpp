#pragma once
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wordgaze/babyai/vocabulary.hpp"

namespace wordgaze::babyai {

/// A mission as words, each with the sub-task that it belongs to (progress.hpp).
struct Sentence {
  std::array<WordId, kMaxMissionWords> words{};  ///< kPadding behind the end
  /// Index of the sub-task that the word belongs to: a clause, or a half of "put A / next to B"; -1
  /// for the words that join clauses ("and", ",", "then", "after", "you") and behind the end.
  std::array<std::int8_t, kMaxMissionWords> sub_task_of{};
  int length = 0;

  /// The words in use.
  auto begin() const { return words.begin(); }
  auto end() const { return words.begin() + length; }

  /// Throws std::length_error behind kMaxMissionWords.
  void append(WordId word, int sub_task) {
    if (length == kMaxMissionWords) throw std::length_error("a mission has at most 73 words");
    words[length] = word;
    sub_task_of[length] = static_cast<std::int8_t>(sub_task);
    ++length;
  }

  bool operator==(const Sentence&) const = default;
};

/// The sentence as the reference writes it: single spaces, the comma glued to the word before it.
std::string text(const Sentence& sentence);

/// The words of a text in the vocabulary, all of one sub-task. Throws std::invalid_argument that
/// names the word that is not in the vocabulary.
Sentence sentence_of(std::string_view text, int sub_task = 0);

}  // namespace wordgaze::babyai
