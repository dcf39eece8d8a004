#include "wordgaze/evaluation/breakdown.hpp"

#include <array>
#include <set>
#include <string_view>

namespace wordgaze::evaluation {
namespace {

constexpr std::array<std::string_view, 4> kVerbs{"go to", "pick up", "open", "put next"};
constexpr std::array<std::string_view, 3> kJoins{"and", "then", "after"};

void append(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

std::string verbs(const babyai::Instruction& instruction) {
  std::string list;
  for (int i = 0; i < instruction.clauses(); ++i) {
    append(list, kVerbs[static_cast<std::size_t>(instruction.clause[i].verb)]);
  }
  return list;
}

std::string joins(const babyai::Instruction& instruction) {
  std::string list;
  for (std::size_t i = 1; i < instruction.count; ++i) {
    append(list, kJoins[static_cast<std::size_t>(instruction.order[i])]);
  }
  return list.empty() ? "none" : list;
}

/// What a description says, its location aside: "red ball", "ball", "red object".
std::string object(const babyai::Description& description) {
  std::string text(description.color ? grid::name(*description.color) : "");
  if (!text.empty()) text += ' ';
  return text += description.type ? grid::name(*description.type) : "object";
}

std::set<std::string> objects(const babyai::Instruction& instruction) {
  std::set<std::string> named;
  for (int i = 0; i < instruction.clauses(); ++i) {
    const auto& clause = instruction.clause[static_cast<std::size_t>(i)];
    named.insert(object(clause.object));
    if (clause.verb == babyai::Verb::put_next) named.insert(object(clause.next_to));
  }
  return named;
}

void count(Breakdown::Counts& counts, const std::string& key, int episodes, int successes) {
  auto& count = counts[key];
  count.episodes += episodes;
  count.successes += successes;
}

}  // namespace

void Breakdown::add(const babyai::Instruction& instruction, bool success) {
  count(by_verb, verbs(instruction), 1, success);
  count(by_join, joins(instruction), 1, success);
  count(by_clauses, std::to_string(instruction.clauses()), 1, success);
  for (const auto& object : objects(instruction)) count(by_object, object, 1, success);
}

void Breakdown::operator+=(const Breakdown& other) {
  for (const auto member :
       {&Breakdown::by_verb, &Breakdown::by_join, &Breakdown::by_clauses, &Breakdown::by_object}) {
    for (const auto& [key, c] : other.*member) {
      count(this->*member, key, c.episodes, c.successes);
    }
  }
}

}  // namespace wordgaze::evaluation
