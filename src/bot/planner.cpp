#include "planner.hpp"

#include <algorithm>
#include <iterator>

#include "drop_place.hpp"
#include "wordgaze/bot/bot.hpp"

namespace wordgaze::bot {

using grid::Action;
using grid::DoorState;
using grid::Type;

namespace {

void expect(bool ok) {
  if (!ok) throw GivesUp{};
}

}  // namespace

Action Planner::next_action(std::optional<Action> taken) {
  Memory::Before& before = memory_.before;
  memory_.seen.look(world_);
  memory_.reach.search(world_, memory_.seen);
  // What is in an opened box may be just what the plan lacks: nobody knows.
  expect(taken != Action::toggle || world_.object(before.ahead).type != Type::box);

  if (!memory_.plan.empty()) {
    const Subgoal subgoal = next();
    if (taken) std::visit([&](const auto& goal) { after(goal, *taken); }, subgoal);
  }
  while (!memory_.plan.empty() && is_exploring()) finish();

  std::optional<Action> action;
  while (!memory_.plan.empty() && !action) {
    const Subgoal subgoal = next();
    action = std::visit([&](const auto& goal) { return act(goal); }, subgoal);
  }
  before = {.agent = world_.agent,
            .carried = world_.carried,
            .ahead = world_.grid[world_.front()],
            .door = ahead().state,
            .suggested = action.value_or(Action::done)};
  return *before.suggested;
}

// --- what was done -------------------------------------------------------------------------------

void Planner::after(Close, Action taken) {
  if (taken == Action::toggle) return finish();
  if (taken == Action::forward || taken == Action::left || taken == Action::right) undo(taken);
}

void Planner::after(Open goal, Action taken) {
  if (taken != Action::toggle) return undo(taken);
  finish();
  if (goal.key == Open::Key::drop) do_first({GoTo{drop_place()}, Drop{}});
}

void Planner::after(Drop, Action taken) {
  if (taken == Action::drop) return finish();
  if (taken == Action::forward || taken == Action::left || taken == Action::right) undo(taken);
}

void Planner::after(PickUp, Action taken) {
  if (taken == Action::pickup) return finish();
  if (taken == Action::left || taken == Action::right) undo(taken);
}

void Planner::after(const GoTo&, Action taken) {
  if (taken == Action::pickup || taken == Action::drop || taken == Action::toggle) undo(taken);
}

// Plans to bring back what an action has changed.
void Planner::undo(Action taken) {
  const Memory::Before& before = memory_.before;
  const bool hands_changed = world_.carried != before.carried;
  switch (taken) {
    case Action::forward:
      if (world_.agent != before.agent) do_first({GoTo{Place{world_.agent}}});
      break;
    case Action::left:
      do_first({GoTo{Place{world_.agent + right()}}});
      break;
    case Action::right:
      do_first({GoTo{Place{world_.agent - right()}}});
      break;
    case Action::drop:
      if (hands_changed) do_first({PickUp{}});
      break;
    case Action::pickup:
      if (hands_changed) do_first({Drop{}});
      break;
    case Action::toggle: {
      const bool is_open = ahead().state == DoorState::open;
      if (ahead().type != Type::door || is_open == (before.door == DoorState::open)) break;
      if (is_open) {
        do_first({Close{}});
      } else {
        do_first({Open{}});
      }
      break;
    }
    case Action::done:
      break;
  }
}

// --- what to do ----------------------------------------------------------------------------------

std::optional<Action> Planner::act(Close) {
  expect(ahead().type == Type::door && ahead().state == DoorState::open);
  return Action::toggle;
}

std::optional<Action> Planner::act(Open goal) {
  const grid::Object& door = ahead();
  expect(door.type == Type::door);
  if (door.state == DoorState::open) {
    do_first({Close{}});
    return std::nullopt;
  }
  if (door.state == DoorState::closed) return Action::toggle;
  if (!carries_key_of(door)) {
    const GoTo key{keys_of(door)};
    const GoTo back{Place{world_.front()}};
    finish();
    if (carries_something()) {
      const GoTo aside{drop_place()};
      do_first({aside, Drop{}, key, PickUp{}, back, Open{}, aside, PickUp{}});
    } else {
      do_first({key, PickUp{}, back, Open{}});
    }
    return std::nullopt;
  }
  if (goal.key == Open::Key::undecided) {
    // Where to drop the key is decided when the door is open: things may have moved by then.
    finish();
    do_first({Open{Open::Key::drop}});
    return std::nullopt;
  }
  return Action::toggle;
}

std::optional<Action> Planner::act(Drop) {
  expect(carries_something() && ahead().type == Type::empty);
  return Action::drop;
}

std::optional<Action> Planner::act(PickUp) {
  expect(!carries_something());
  return Action::pickup;
}

std::optional<Action> Planner::act(Explore) {
  const auto unseen =
      memory_.reach.closest(Through::objects, [&](Position p) { return !memory_.seen[p]; });
  if (unseen) {
    do_first({GoTo{Place{unseen}, GoTo::Purpose::explore}});
    return std::nullopt;
  }
  // A locked door only if there is no other: it may be the one that this exploration is for.
  auto door = memory_.reach.closest(Through::objects, [&](Position p) {
    return world_.object_at(p).type == Type::door && world_.object_at(p).state == DoorState::closed;
  });
  if (!door) {
    door = memory_.reach.closest(Through::objects, [&](Position p) {
      return world_.object_at(p).type == Type::door && world_.object_at(p).state != DoorState::open;
    });
  }
  expect(door.has_value());
  const grid::Object& object = world_.object_at(*door);
  // A key that is in hand already may be needed again.
  const bool keep = object.state == DoorState::locked && carries_key_of(object);
  finish();
  do_first({GoTo{Door{world_.grid[*door]}, GoTo::Purpose::open},
            Open{keep ? Open::Key::keep : Open::Key::undecided}});
  return std::nullopt;
}

// --- the plan and the world ----------------------------------------------------------------------

const Subgoal& Planner::next() {
  expect(++looks_ <= Bot::kMaxLooks);
  return memory_.plan.back();
}

void Planner::do_first(std::initializer_list<Subgoal> subgoals) {
  std::reverse_copy(subgoals.begin(), subgoals.end(), std::back_inserter(memory_.plan));
}

// What is explored for may have come into view.
bool Planner::is_exploring() {
  const Subgoal& subgoal = next();
  const GoTo* way = std::get_if<GoTo>(&subgoal);
  return std::holds_alternative<Explore>(subgoal) ||
         (way != nullptr && way->purpose == GoTo::Purpose::explore);
}

bool Planner::carries_key_of(const grid::Object& door) const {
  const grid::Object& carried = world_.object(world_.carried);
  return carried.type == Type::key && carried.color == door.color;
}

Key Planner::keys_of(const grid::Object& door) {
  const Sought found(standing_keys(world_, door.color));
  std::vector<Sought>& known = memory_.keys;
  const auto same = std::find(known.begin(), known.end(), found);
  const Key key{static_cast<int>(same - known.begin())};
  if (same == known.end()) known.push_back(found);
  return key;
}

Place Planner::drop_place(Place reserved) const {
  return {find_drop_place(world_, memory_.seen, memory_.reach, reserved.position)};
}

}  // namespace wordgaze::bot
