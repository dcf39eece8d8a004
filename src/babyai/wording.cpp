#include "wordgaze/babyai/wording.hpp"

namespace wordgaze::babyai {
namespace {

constexpr int kJoining = -1;

consteval WordId operator""_w(const char* text, std::size_t length) {
  return word_id({text, length}).value();
}

template <std::size_t n>
consteval std::array<WordId, n> word_ids(const std::array<std::string_view, n>& names) {
  std::array<WordId, n> ids{};
  // Names that no mission uses ("unseen") stay padding.
  for (std::size_t k = 0; k < n; ++k) ids[k] = word_id(names[k]).value_or(kPadding);
  return ids;
}
constexpr auto kTypeWords = word_ids(grid::kTypeNames);
constexpr auto kColorWords = word_ids(grid::kColorNames);

}  // namespace

WordId word_of(grid::Type type) { return kTypeWords[static_cast<int>(type)]; }
WordId word_of(grid::Color color) { return kColorWords[static_cast<int>(color)]; }

namespace {

class Writer {
 public:
  explicit Writer(const Meaning& meaning) : meaning_(meaning) {}

  void clause(const Instruction& instruction, int k) {
    clause(instruction.clause[k], meaning_.object[k], meaning_.next_to[k]);
  }
  void join(Order order) {
    switch (order) {
      case Order::any:
        return write({"and"_w}, kJoining);
      case Order::before:
        return write({","_w, "then"_w}, kJoining);
      case Order::after:
        return write({"after"_w, "you"_w}, kJoining);
    }
  }
  const Sentence& sentence() const { return sentence_; }

 private:
  void write(std::initializer_list<WordId> words, int sub_task) {
    for (WordId word : words) sentence_.append(word, sub_task);
  }
  void write(std::initializer_list<WordId> words) { write(words, sub_task_); }

  void clause(const Clause& clause, grid::ObjectSet object, grid::ObjectSet next_to) {
    switch (clause.verb) {
      case Verb::go_to:
        write({"go"_w, "to"_w});
        break;
      case Verb::pickup:
        write({"pick"_w, "up"_w});
        break;
      case Verb::open:
        write({"open"_w});
        break;
      case Verb::put_next:
        write({"put"_w});
        break;
    }
    description(clause.object, object);
    ++sub_task_;
    if (clause.verb == Verb::put_next) {
      write({"next"_w, "to"_w});
      description(clause.next_to, next_to);
      ++sub_task_;
    }
  }

  void description(const Description& d, grid::ObjectSet meant) {
    write({several(meant) ? "a"_w : "the"_w});
    if (d.color) write({word_of(*d.color)});
    write({d.type ? word_of(*d.type) : "object"_w});
    switch (d.location) {
      case Location::anywhere:
        break;
      case Location::left:
        write({"on"_w, "your"_w, "left"_w});
        break;
      case Location::right:
        write({"on"_w, "your"_w, "right"_w});
        break;
      case Location::front:
        write({"in"_w, "front"_w, "of"_w, "you"_w});
        break;
      case Location::behind:
        write({"behind"_w, "you"_w});
        break;
    }
  }

  const Meaning& meaning_;
  Sentence sentence_;
  int sub_task_ = 0;
};

}  // namespace

Sentence wording(const Instruction& instruction, const Meaning& meaning) {
  Writer writer(meaning);
  for (int k = 0; k < instruction.clauses(); ++k) {
    if (k > 0) writer.join(instruction.order[k]);
    writer.clause(instruction, k);
  }
  return writer.sentence();
}

}  // namespace wordgaze::babyai
