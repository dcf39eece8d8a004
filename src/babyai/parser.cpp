#include "wordgaze/babyai/parser.hpp"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/core/formatted.hpp"

namespace wordgaze::babyai {
namespace {

// Recursive descent; each function reads one rule of the grammar.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) { advance(); }

  Instruction mission() {
    Instruction whole = sequence();
    if (accept("after")) {
      expect("you");
      whole = ordered(whole, Order::after, sequence());
    }
    if (!word_.empty()) fail({"the end"});
    return whole;
  }

 private:
  Instruction sequence() {
    Instruction whole = part();
    while (accept(",")) {
      expect("then");
      whole = ordered(whole, Order::before, part());
    }
    return whole;
  }

  Instruction part() {
    const Clause first = clause();
    return accept("and") ? both(first, clause()) : single(first);
  }

  Clause clause() {
    if (clauses_++ == Instruction::kMaxClauses) {
      fail({formatted("at most {} clauses", Instruction::kMaxClauses)});
    }
    Clause clause;
    if (accept("go")) {
      expect("to");
      clause.verb = Verb::go_to;
    } else if (accept("pick")) {
      expect("up");
      clause.verb = Verb::pickup;
    } else if (accept("open")) {
      clause.verb = Verb::open;
    } else if (accept("put")) {
      clause.verb = Verb::put_next;
    } else {
      fail({"go to", "pick up", "open", "put"});
    }
    clause.object = description();
    if (clause.verb == Verb::put_next) {
      expect("next");
      expect("to");
      clause.next_to = description();
    }
    return clause;
  }

  Description description() {
    if (!accept("the") && !accept("a")) fail({"the", "a"});
    Description d;
    d.color = color();
    d.type = type(d.color.has_value());
    d.location = location();
    return d;
  }

  std::optional<grid::Color> color() {
    for (grid::Color color : grid::kColorsToDraw) {
      if (accept(name(color))) return color;
    }
    return std::nullopt;
  }

  std::optional<grid::Type> type(bool has_color) {
    using grid::Type;
    if (accept("object")) return std::nullopt;
    for (Type type : {Type::ball, Type::box, Type::key, Type::door}) {
      if (accept(name(type))) return type;
    }
    if (has_color) fail({"ball", "box", "key", "door", "object"});
    fail({"a color", "ball", "box", "key", "door", "object"});
  }

  Location location() {
    if (accept("in")) {
      expect("front");
      expect("of");
      expect("you");
      return Location::front;
    }
    if (accept("behind")) {
      expect("you");
      return Location::behind;
    }
    if (accept("on")) {
      expect("your");
      if (accept("left")) return Location::left;
      if (accept("right")) return Location::right;
      fail({"left", "right"});
    }
    return Location::anywhere;
  }

  bool accept(std::string_view word) {
    if (word_ != word) return false;
    advance();
    return true;
  }
  void expect(std::string_view word) {
    if (!accept(word)) fail({word});
  }

  // To the next word; a comma is one. Empty at the end.
  void advance() {
    const std::size_t begin = std::min(text_.find_first_not_of(' ', end_), text_.size());
    end_ = text_.substr(begin, 1) == "," ? begin + 1
                                         : std::min(text_.find_first_of(" ,", begin), text_.size());
    word_ = text_.substr(begin, end_ - begin);
  }

  [[noreturn]] void fail(std::initializer_list<std::string_view> expected) const {
    std::string choice;
    for (std::string_view word : expected) {
      if (!choice.empty()) choice += " | ";
      choice += word;
    }
    const std::string found = word_.empty() ? "the end" : formatted("'{}'", word_);
    const std::string to_the_word(end_ - word_.size(), ' ');
    throw std::invalid_argument(formatted("mission: expected {}, found {}\n  {}\n  {}^", choice,
                                          found, text_, to_the_word));
  }

  std::string_view text_;
  std::size_t end_ = 0;  // behind word_
  std::string_view word_;
  int clauses_ = 0;
};

}  // namespace

Instruction parse_mission(std::string_view text) { return Parser(text).mission(); }

Sentence parse_sentence(std::string_view text) {
  Sentence sentence = sentence_of(text);
  try {
    // Word by word the same but for the articles, which say nothing.
    sentence.sub_task_of = wording(parse_mission(text), Meaning{}).sub_task_of;
  } catch (const std::invalid_argument&) {
    // Not of the Baby language.
  }
  return sentence;
}

}  // namespace wordgaze::babyai
