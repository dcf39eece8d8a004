#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/require.hpp"

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
inline std::string text(const Sentence& sentence) {
  std::string out;
  for (const WordId id : sentence) {
    if (!out.empty() && word(id) != ",") out += ' ';
    out += word(id);
  }
  return out;
}

/// The words of a text in the vocabulary, all of one sub-task. Throws std::invalid_argument that
/// names the words that are not in the vocabulary.
inline Sentence sentence_of(std::string_view text, int sub_task = 0) {
  Sentence sentence;
  std::string unknown;
  std::size_t start = 0;
  while ((start = text.find_first_not_of(' ', start)) != text.npos) {
    // A comma is a word of its own.
    const std::size_t end = text[start] == ',' ? start + 1 : text.find_first_of(" ,", start);
    const std::string_view part = text.substr(start, end - start);
    start = end;
    const std::optional<WordId> id = word_id(part);
    if (!id) {
      unknown.append(unknown.empty() ? "'" : ", '").append(part).append("'");
      continue;
    }
    require(sentence.length < kMaxMissionWords, "mission '{}': more than {} words", text,
            kMaxMissionWords);
    sentence.append(*id, sub_task);
  }
  require(unknown.empty(), "mission '{}': not in the vocabulary: {}", text, unknown);
  return sentence;
}

}  // namespace wordgaze::babyai
