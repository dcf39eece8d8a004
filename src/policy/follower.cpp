#include "wordgaze/policy/follower.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "wordgaze/core/require.hpp"

namespace wordgaze::policy {
namespace {

using babyai::Clause;
using babyai::Description;
using babyai::Verb;
using grid::Action;
using Part = babyai::Instruction::Part;

constexpr int kAheadX = View::kAgentX, kAheadY = View::kAgentY - 1;

bool fits(const Cell& cell, const Description& d) {
  // "object" is what can be carried, a door, or a wall; not floor, goal or lava.
  const bool is_object = cell.type == grid::Type::wall || cell.type == grid::Type::door ||
                         cell.type == grid::Type::key || cell.type == grid::Type::ball ||
                         cell.type == grid::Type::box;
  return (d.type ? cell.type == *d.type : is_object) && (!d.color || cell.color == *d.color);
}

// Cells beside the one ahead; the fourth is the agent's.
bool any_beside_ahead(const View& view, const Description& d) {
  return fits(view.at(kAheadX - 1, kAheadY), d) || fits(view.at(kAheadX + 1, kAheadY), d) ||
         fits(view.at(kAheadX, kAheadY - 1), d);
}

}  // namespace

Follower::Follower(const babyai::Instruction& instruction, Counts counts)
    : instruction_(instruction), counts_(counts) {
  for (int k = 0; k < instruction.clauses(); ++k) {
    for (const Description& d : {instruction.clause[k].object, instruction.clause[k].next_to}) {
      require(d.location == babyai::Location::anywhere,
              "a mission with a place (\"on your left\") cannot be followed by views: it is seen "
              "from where the agent began; say what is done yourself");
    }
  }
}

void Follower::see(const View& view, std::optional<Action> action) {
  hand_ = view.carried();
  if (!action) return;
  if (counts_ == Counts::when_declared && *action == Action::done) {
    for (std::size_t k = 0; k < done_.size(); ++k) done_[k] = done_[k] || matched_[k];
    matched_ = {};
    return;
  }
  Clauses& found = counts_ == Counts::when_declared ? matched_ : done_;
  for (Part part = instruction_.first(); part.size() > 0; part = instruction_.next(part)) {
    if (completed(part)) continue;
    for (int k = part.begin; k < part.end; ++k) {
      if (!done_[k]) found[k] = came_true(k, view, *action);
    }
    // The action that completes a part may complete the next one as well.
    if (!completed(part)) return;
  }
}

bool Follower::completed(Part part) const {
  return std::all_of(done_.begin() + part.begin, done_.begin() + part.end,
                     [](bool done) { return done; });
}

bool Follower::came_true(int k, const View& view, Action action) {
  const Clause& clause = instruction_.clause[k];
  const Cell held = std::exchange(held_[k], hand_), ahead = view.at(kAheadX, kAheadY);
  switch (clause.verb) {
    case Verb::go_to:
      return fits(ahead, clause.object);
    case Verb::open:
      return action == Action::toggle && ahead.type == grid::Type::door &&
             ahead.state == grid::DoorState::open && fits(ahead, clause.object);
    case Verb::pickup:
      return action == Action::pickup && held.type == grid::Type::empty &&
             fits(hand_, clause.object);
    case Verb::put_next:
      return action == Action::drop && fits(held, clause.object) &&
             hand_.type == grid::Type::empty && ahead == held &&
             any_beside_ahead(view, clause.next_to);
  }
  return false;
}

std::array<std::uint8_t, model::kMaxSubTasks> Follower::completion() const {
  std::array<std::uint8_t, model::kMaxSubTasks> completion{};
  std::size_t sub_task = 0;
  for (int k = 0; k < instruction_.clauses(); ++k) {
    const Clause& clause = instruction_.clause[k];
    if (clause.verb == Verb::put_next) {
      completion[sub_task++] = done_[k] || fits(hand_, clause.object);
    }
    completion[sub_task++] = done_[k];
  }
  return completion;
}

}  // namespace wordgaze::policy
