#include "wordgaze/trace/level_docs.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <ostream>
#include <set>

#include "wordgaze/env/environment.hpp"

namespace wordgaze::trace {
namespace {

using babyai::Clause;
using babyai::Instruction;
using babyai::Verb;
using babyai::WordId;

constexpr int kEpisodes = 300;
constexpr std::size_t kFormsListed = 5;

std::string_view form(Verb verb) {
  switch (verb) {
    case Verb::go_to:
      return "go to D";
    case Verb::pickup:
      return "pick up D";
    case Verb::open:
      return "open D";
    case Verb::put_next:
      return "put D next to D";
  }
  return "";
}

// "go to D, then open D"
std::string form(const Instruction& i) {
  constexpr std::array<std::string_view, 3> kJoins{" and ", ", then ", " after you "};
  std::string text{form(i.clause[0].verb)};
  for (int k = 1; k < i.clauses(); ++k) {
    text += kJoins[static_cast<std::size_t>(i.order[k])];
    text += form(i.clause[k].verb);
  }
  return text;
}

// The missions of a level as it draws them: D stands for a description.
class MissionForms {
 public:
  void add(const env::Environment& env) {
    const Instruction& instruction = env.instruction();
    if (instruction.clauses() > 0) {
      forms_.insert(form(instruction));
      for (int k = 0; k < instruction.clauses(); ++k) verbs_.insert(instruction.clause[k].verb);
    } else {
      add_text(env.sentence());
    }
  }

  std::string text() const {
    std::set<std::string> all = forms_;
    for (const auto& [pattern, words] : texts_) all.insert(joined(words));
    if (all.size() <= kFormsListed) return fmt::format("{}", fmt::join(all, "; "));
    std::vector<std::string_view> verbs;
    for (Verb verb : verbs_) verbs.push_back(form(verb));
    return fmt::format("{}; joined by \"and\", \", then\", \"after you\"", fmt::join(verbs, "; "));
  }

 private:
  using Words = std::vector<std::string>;

  static std::string variable(std::string_view word) {
    const auto among = [&](const auto& names) {
      return std::find(names.begin(), names.end(), word) != names.end();
    };
    return among(grid::kColorNames) ? "C" : among(grid::kTypeNames) ? "T" : std::string(word);
  }

  // Texts that differ in colors and types only are one pattern; words that never differ stay.
  void add_text(const babyai::Sentence& sentence) {
    Words words, pattern;
    for (WordId id : sentence) {
      words.emplace_back(babyai::word(id));
      pattern.push_back(variable(words.back()));
    }
    const auto [known, is_new] = texts_.try_emplace(pattern, words);
    for (std::size_t k = 0; !is_new && k < words.size(); ++k) {
      if (known->second[k] != words[k]) known->second[k] = pattern[k];
    }
  }

  static std::string joined(const Words& words) {
    std::string text;
    for (const std::string& word : words) {
      if (!text.empty() && word != ",") text += ' ';
      text += word;
    }
    return text.empty() ? "(none)" : text;
  }

  std::set<std::string> forms_;
  std::set<Verb> verbs_;
  std::map<Words, Words> texts_;
};

std::string step_limit(const babyai::LevelSpec& level) {
  if (level.max_steps != 0) return std::to_string(level.max_steps);
  return fmt::format("{} n", level.room_size * level.room_size * level.rows * level.columns);
}

std::string rooms(const babyai::LevelSpec& level) {
  if (level.rule != babyai::Rule::instruction && level.rows * level.columns == 1) return "";
  return fmt::format("{} x {} of {}", level.columns, level.rows, level.room_size);
}

void write_row(std::ostream& out, const babyai::LevelSpec& level) {
  env::Environment env(level);
  MissionForms forms;
  for (std::uint64_t seed = 0; seed < kEpisodes; ++seed) {
    env.reset(seed);
    forms.add(env);
  }
  const grid::Grid& grid = env.world().grid;
  fmt::print(out, "| {} | {} x {} | {} | {} | {} | {} |\n", level.id, grid.width(), grid.height(),
             rooms(level), step_limit(level), level.see_through_walls ? "yes" : "no", forms.text());
}

}  // namespace

void write_level_docs(std::ostream& out) {
  out << R"(# Levels

Written by `wordgaze levels --page > docs/levels.md`; a test compares.

Every level gives the worlds of minigrid 3.2.0 for the same seed. In a mission, D stands for a
description ("the red ball on your left"), C for a color and T for a type. A step limit of `64 n`
is 64 for each place that the instruction has the agent go to: one a clause, two for "put next to".
Without walls in sight ("sees through"), nothing hides what lies behind it. All levels have seven
actions but Dynamic-Obstacles, which has the first three.

Besides these there are Wordgaze's own one-room tasks, for any room and number of objects that fit:
`Wordgaze-One-N8-K4-v0` has one target among 4 objects of different kinds in a room of 8 x 8 cells
(walls included), `Wordgaze-Two-N8-K4-v0` two targets joined by "and", ", then" or "after you",
`Wordgaze-Three-N8-K4-v0` and `Wordgaze-Four-N8-K4-v0` three and four as in "A and B, then C" and "A
and B after you C and D", `Wordgaze-Five-N8-K8-v0`, `Six`, `Seven` and `Eight` a chain of them, as in "A, then B and C, then D
after you E and F". Each clause is declared by its own `done`; in the same ids with `-auto`
(`Wordgaze-One-N8-K4-auto-v0`) the verifier decides by itself. N is at least 5; K is at least the number of clauses, at most 18,
and at most half the free cells.

An id of any level takes other rooms and another number of scattered objects, where it has such numbers and they fit:
`BabyAI-GoToLocal-v0[room_size=10][objects=4]`. Step limits that are fixed stay. `babyai::register_level` adds levels of
one's own to this list.

The six MiniGrid-WFC levels are left out: the patterns that they are made from are missing from the
reference's own package.

| id | cells | rooms | step limit | sees through | missions |
|---|---|---|---|---|---|
)";
  for (const babyai::LevelSpec& level : babyai::built_in_levels()) write_row(out, level);
}

}  // namespace wordgaze::trace
