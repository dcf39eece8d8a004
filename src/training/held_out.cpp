#include "wordgaze/training/held_out.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::training {
namespace {

constexpr std::string_view kBlank = " ";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  return text.substr(0, text.find_last_not_of(kBlank) + 1);
}

/// The grammar of missions reads it as a whole sentence would say it.
babyai::Description parse_kind(std::string_view text) {
  const auto fail = [&] {
    require(false,
            "held_out: '{}' is not a kind of object; expected a color and key, ball or box, as in "
            "\"red ball, blue key\"",
            text);
  };
  babyai::Instruction mission;
  try {
    mission = babyai::parse_mission(fmt::format("go to the {}", text));
  } catch (const std::invalid_argument&) {
    fail();
  }
  const auto& kind = mission.clause[0].object;
  using grid::Type;
  const bool carried = kind.type == Type::key || kind.type == Type::ball || kind.type == Type::box;
  if (mission.clauses() != 1 || !carried || !kind.color ||
      kind.location != babyai::Location::anywhere) {
    fail();
  }
  return kind;
}

}  // namespace

HeldOut::HeldOut(std::string_view list) {
  while (!trimmed(list).empty()) {
    const auto comma = std::min(list.find(','), list.size());
    kinds_.push_back(parse_kind(trimmed(list.substr(0, comma))));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
}

bool HeldOut::contains(const babyai::Description& description) const {
  return std::ranges::any_of(kinds_, [&](const babyai::Description& kind) {
    return kind.type == description.type && kind.color == description.color;
  });
}

bool HeldOut::named_in(const babyai::Instruction& instruction) const {
  return std::any_of(instruction.clause.begin(), instruction.clause.begin() + instruction.clauses(),
                     [&](const babyai::Clause& clause) {
                       return contains(clause.object) || contains(clause.next_to);
                     });
}

}  // namespace wordgaze::training
