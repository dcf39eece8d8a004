#include "wordgaze/babyai/sentence.hpp"

#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {

std::string text(const Sentence& sentence) {
  std::string out;
  for (WordId id : sentence) {
    if (!out.empty() && word(id) != ",") out += ' ';
    out += word(id);
  }
  return out;
}

Sentence sentence_of(std::string_view text, int sub_task) {
  Sentence sentence;
  std::size_t start = 0;
  while ((start = text.find_first_not_of(' ', start)) != text.npos) {
    // A comma is a word of its own.
    const std::size_t end = text[start] == ',' ? start + 1 : text.find_first_of(" ,", start);
    const std::string_view part = text.substr(start, end - start);
    const std::optional<WordId> id = word_id(part);
    require(id.has_value(), "mission '{}': '{}' is not in the vocabulary", text, part);
    require(sentence.length < kMaxMissionWords, "mission '{}': more than {} words", text,
            kMaxMissionWords);
    sentence.append(*id, sub_task);
    start = end;
  }
  return sentence;
}

}  // namespace wordgaze::babyai
