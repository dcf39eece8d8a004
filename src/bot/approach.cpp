#include <algorithm>
#include <variant>

#include "planner.hpp"
#include "wordgaze/grid/observation.hpp"

// How the bot goes somewhere.
namespace wordgaze::bot {

using grid::Action;
using grid::DoorState;
using grid::ObjectId;
using grid::Position;
using grid::Type;

namespace {

// Lower bounds of the actions it takes to move one thing out of the way, with empty hands and with
// something in them.
constexpr int kClearing = 4, kClearingWithFullHands = 7;

bool is_wall_or_door(const grid::Object& object) {
  return object.type == Type::wall || object.type == Type::door;
}

bool can_be_stepped_on(const grid::Object& object) {
  return object.type == Type::empty ||
         (object.type == Type::door && object.state == DoorState::open);
}

}  // namespace

std::optional<Action> Planner::act(const GoTo& goal) {
  const bool beside = goal.purpose == GoTo::Purpose::put_next;
  const auto target = find(goal.target, beside);
  if (!target) {
    do_first({Explore{}});
    return std::nullopt;
  }
  const grid::Object& object = world_.object(target->object);
  if (goal.purpose == GoTo::Purpose::open && object.type == Type::door &&
      object.state == DoorState::locked && !carries_something()) {
    // From here on it is this door, whichever else the phrase may mean.
    const GoTo key{keys_of(object)};
    finish();
    do_first({key, PickUp{}, GoTo{Door{target->object}, GoTo::Purpose::open}});
    return std::nullopt;
  }
  const int from_agent = manhattan(target->place, world_.agent);
  if (from_agent == (beside ? 1 : 0)) return step_aside();

  const int from_front = manhattan(target->place, world_.front());
  if (from_front == (beside ? 1 : 0)) {
    if (!beside || ahead().type == Type::empty) {
      finish();
      return std::nullopt;
    }
    if (can_be_stepped_on(ahead())) {
      // Nothing can be dropped in a doorway: walk on, so that the thing behind it gets moved.
      const Position step = forward(world_.direction);
      do_first({GoTo{Place{world_.front() + step + step}}});
      return std::nullopt;
    }
  }
  const auto route = memory_.reach.route(target->place);
  if (!route || route->steps == 0) {
    do_first({Explore{}});
    return std::nullopt;
  }
  if (route->first == world_.front()) return walk_on();
  return turn_towards(route->first);
}

// Where the target is; none for an object that is not in view yet.
std::optional<Planner::Found> Planner::find(const Target& target, bool beside) const {
  if (const auto* meant = std::get_if<Meant>(&target)) {
    return closest(memory_.phrases[meant->phrase], beside);
  }
  if (const auto* key = std::get_if<Key>(&target)) return closest(memory_.keys[key->keys], beside);
  if (const auto* door = std::get_if<Door>(&target)) {
    return Found{door->id, world_.object(door->id).position};
  }
  const std::optional<Position> place = std::get<Place>(target).position;
  if (!place) throw GivesUp{};
  return Found{grid::kNothing, *place};
}

std::optional<Planner::Found> Planner::closest(const Sought& sought, bool beside) const {
  if (sought.objects.empty()) throw GivesUp{};
  std::optional<Found> best;
  int fewest_steps = 0;
  const std::size_t known = std::min(sought.objects.size(), sought.places.size());
  for (std::size_t k = 0; k < known; ++k) {
    const Found found{sought.objects[k], sought.places[k]};
    if (found.object == grid::kWall || found.object == world_.carried) continue;
    if (!memory_.seen[found.place]) continue;
    const auto route = memory_.reach.route(found.place);
    if (!route) throw GivesUp{};
    int steps = route->steps;
    if (route->through_objects) steps += carries_something() ? kClearingWithFullHands : kClearing;
    // Whoever stands on it, or too close to put something beside it, has to step back first.
    if (steps == 0) steps = beside ? 3 : 2;
    if (beside && steps == 1) steps = 3;
    if (best && steps >= fewest_steps) continue;
    best = found;
    fewest_steps = steps;
  }
  return best;
}

// Off a cell, or away from one.
Action Planner::step_aside() const {
  if (can_be_stepped_on(ahead())) return Action::forward;
  if (can_be_stepped_on(world_.object_at(world_.agent + right()))) return Action::right;
  return Action::left;
}

// Towards the next cell of a way, which is not ahead.
Action Planner::turn_towards(Position neighbor) const {
  if (neighbor == world_.agent + right()) return Action::right;
  if (neighbor == world_.agent - right()) return Action::left;
  // It is behind: turn to the side that is open farther, to see more on the way.
  const auto free_distance = [&](Position step) {
    Position p = world_.agent;
    for (int distance = 1; distance <= grid::kViewSize / 2; ++distance) {
      p = p + step;
      if (is_wall_or_door(world_.object_at(p))) return distance;
    }
    return grid::kViewSize / 2;
  };
  const bool left_is_open_farther = free_distance(Position{} - right()) > free_distance(right());
  return left_is_open_farther ? Action::left : Action::right;
}

// To the cell ahead, whatever it takes.
std::optional<Action> Planner::walk_on() {
  const grid::Object& object = ahead();
  if (can_be_stepped_on(object)) return Action::forward;
  if (object.type == Type::door) {
    if (object.state == DoorState::locked) throw GivesUp{};
    do_first({Open{}});
  } else {
    clear_the_way();
  }
  return std::nullopt;
}

// Puts what is ahead elsewhere; what is carried meanwhile waits somewhere.
void Planner::clear_the_way() {
  const Place here = drop_place();
  if (!carries_something()) {
    do_first({PickUp{}, GoTo{here}, Drop{}});
    return;
  }
  const GoTo obstacle{Place{world_.front()}};
  const GoTo elsewhere{drop_place(here)};
  do_first({GoTo{here}, Drop{}, obstacle, PickUp{}, elsewhere, Drop{}, GoTo{here}, PickUp{}});
}

}  // namespace wordgaze::bot
