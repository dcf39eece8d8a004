#pragma once
#include <array>
#include <string>

#include "wordgaze/babyai/vocabulary.hpp"

namespace wordgaze::babyai {

/// A mission as words, each with the clause that it belongs to.
struct Sentence {
  std::array<WordId, kMaxMissionWords> words{};  ///< kPadding behind the end
  /// Index of the clause that the word belongs to; -1 for the words that join clauses ("and",
  /// ",", "then", "after", "you") and behind the end.
  std::array<std::int8_t, kMaxMissionWords> clause_of{};
  int length = 0;

  /// The words in use.
  auto begin() const { return words.begin(); }
  auto end() const { return words.begin() + length; }

  void append(WordId word, int clause) {
    words[length] = word;
    clause_of[length] = static_cast<std::int8_t>(clause);
    ++length;
  }

  bool operator==(const Sentence&) const = default;
};

/// The sentence as the reference writes it: single spaces, the comma glued to the word before it.
std::string text(const Sentence& sentence);

/// The words of a text in the vocabulary, all of one clause. Throws std::invalid_argument that
/// names the word that is not in the vocabulary.
Sentence sentence_of(std::string_view text, int clause = 0);

}  // namespace wordgaze::babyai
