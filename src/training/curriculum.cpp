#include "wordgaze/training/curriculum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "wordgaze/core/require.hpp"
#include "wordgaze/optim/schedule.hpp"

namespace wordgaze::training {

using babyai::Verb;

namespace {

constexpr int kMostTries = 10'000;
constexpr int kFirstObject = grid::kWall + 1;

/// Whether the agent can walk to a cell beside this one.
bool reachable(const grid::World& world, grid::Position target) {
  const auto index = [&](grid::Position p) {
    return static_cast<std::size_t>(p.y * world.grid.width() + p.x);
  };
  std::vector<bool> seen(static_cast<std::size_t>(world.grid.width() * world.grid.height()));
  std::vector<grid::Position> open{world.agent};
  while (!open.empty()) {
    const auto from = open.back();
    open.pop_back();
    for (const auto direction : {grid::Direction::right, grid::Direction::down,
                                 grid::Direction::left, grid::Direction::up}) {
      const auto to = from + grid::forward(direction);
      if (to == target) return true;
      if (world.grid[to] != grid::kNothing || seen[index(to)]) continue;
      seen[index(to)] = true;
      open.push_back(to);
    }
  }
  return false;
}

grid::ObjectId first_of(grid::ObjectSet set) {
  return static_cast<grid::ObjectId>(std::countr_zero(set));
}

/// Whether the agent could have it in hand, were it near.
bool can_be_taken(const grid::World& world, grid::ObjectId id) {
  return world.carried == grid::kNothing && world.stands(id) &&
         grid::can_be_carried(world.object(id));
}

/// Moves objects to cells around the target of the first clause, as long as the agent can still
/// walk to every target.
void huddle(env::Environment& environment, core::Rng& rng) {
  const auto& world = environment.world();
  const auto& meant = environment.meaning().object;
  const auto targets_reachable = [&] {
    return std::all_of(meant.begin(), meant.end(), [&](grid::ObjectSet set) {
      return set == 0 || reachable(world, world.object(first_of(set)).position);
    });
  };
  if (meant[0] == 0 || babyai::several(meant[0])) return;
  const auto target = first_of(meant[0]);
  const auto center = world.object(target).position;
  for (grid::ObjectId id = kFirstObject; id < world.objects.size(); ++id) {
    if (id == target || !world.stands(id)) continue;
    const auto home = world.object(id).position;
    const auto dx = static_cast<std::int16_t>(rng.below(3) - 1);
    const auto dy = static_cast<std::int16_t>(rng.below(3) - 1);
    const grid::Position to = center + grid::Position{dx, dy};
    if (world.grid[to] != grid::kNothing || to == world.agent) continue;
    environment.move_object(id, to);
    if (!targets_reachable()) environment.move_object(id, home);
  }
}

/// Marks a clause whose turn it is; where there are several, either is a fair start.
void complete_one(env::Environment& environment, core::Rng& rng) {
  std::vector<int> clauses;
  const auto turn = environment.declarable();
  for (int k = 0; k < static_cast<int>(turn.size()); ++k) {
    if (turn[static_cast<std::size_t>(k)]) clauses.push_back(k);
  }
  const int pick = clauses.size() > 1 ? rng.below(static_cast<int>(clauses.size())) : 0;
  environment.mark_completed(clauses[static_cast<std::size_t>(pick)]);
}

/// One of the objects that can be carried, or nothing.
grid::ObjectId any_object(const grid::World& world, core::Rng& rng) {
  grid::ObjectId chosen = grid::kNothing;
  int found = 0;
  for (grid::ObjectId id = kFirstObject; id < world.objects.size(); ++id) {
    if (!world.stands(id) || !grid::can_be_carried(world.object(id))) continue;
    if (rng.below(++found) == 0) chosen = id;
  }
  return chosen;
}

/// Makes every clause ask for some object of the world by its color or its type alone.
void describe_partly(const grid::World& world, babyai::Instruction& wanted, core::Rng& rng) {
  for (int i = 0; i < wanted.clauses(); ++i) {
    auto& clause = wanted.clause[static_cast<std::size_t>(i)];
    if (clause.verb == Verb::open) continue;  // what can be carried cannot be opened
    const auto id = any_object(world, rng);
    if (id == grid::kNothing) return;
    const auto& object = world.object(id);
    clause.object = rng.below(2) == 0 ? babyai::Description{.type = object.type}
                                      : babyai::Description{.color = object.color};
  }
}

/// Whether an episode has something to be done that is not all of it.
bool can_be_half_done(const babyai::Instruction& instruction) {
  return instruction.clauses() > 1 || instruction.clause[0].verb == Verb::put_next;
}

/// Starts with the first of some objects in hand that can be; where the hand is full or there is
/// none, nothing changes.
bool take_one(env::Environment& environment, grid::ObjectSet of) {
  for (; of != 0; of &= of - 1) {
    if (!can_be_taken(environment.world(), first_of(of))) continue;
    environment.take_object(first_of(of));
    return true;
  }
  return false;
}

/// With several clauses, marks from one to all but one, in an order that the mission allows; a
/// single "put next" starts with its object in hand. Returns whether anything has changed.
bool half_do(env::Environment& environment, core::Rng& rng) {
  const int most = environment.instruction().clauses() - 1;
  if (most == 0) return take_one(environment, environment.meaning().object[0]);
  const int marks = most > 1 ? 1 + rng.below(most) : 1;
  for (int i = 0; i < marks; ++i) complete_one(environment, rng);
  return true;
}

}  // namespace

void Curriculum::Window::add(bool s) {
  success[next] = s;
  next = (next + 1) % kWindow;
  size = std::min(size + 1, kWindow);
}

double Curriculum::Window::rate() const {
  if (size == 0) return 0;
  return static_cast<double>(std::count(success.begin(), success.begin() + size, 1)) /
         static_cast<double>(size);
}

Curriculum::Curriculum(const CurriculumConfig& config)
    : config_(config),
      held_out_(config.held_out),
      pickup_only_(config.pickup_first),
      half_done_(config.half_done_start) {}

Curriculum::Preparation Curriculum::prepare(env::Environment& environment, core::Rng& rng) const {
  Preparation prepared;
  for (int tries = 0; held_out_.named_in(environment.instruction()); ++tries) {
    if (tries == kMostTries) {
      throw std::runtime_error(fmt::format(
          "curriculum: {} missions of {} in a row name an object of held_out = \"{}\"; hold out "
          "fewer",
          kMostTries, environment.id(), config_.held_out));
    }
    environment.reset();
  }
  babyai::Instruction wanted = environment.instruction();
  if (config_.single_clause > 0 && wanted.clauses() > 1 && rng.uniform() < config_.single_clause) {
    const auto pick = static_cast<std::size_t>(rng.below(wanted.clauses()));
    wanted = babyai::single(wanted.clause[pick]);
  }
  if (pickup_only_ || config_.balance) {
    const double share = pickup_only_ ? 0 : go_to_share_;
    for (int i = 0; i < wanted.clauses(); ++i) {
      Verb& verb = wanted.clause[static_cast<std::size_t>(i)].verb;
      if (verb != Verb::go_to && verb != Verb::pickup) continue;
      verb = rng.uniform() < share ? Verb::go_to : Verb::pickup;
    }
  }
  if (config_.partial > 0 && rng.uniform() < config_.partial) {
    describe_partly(environment.world(), wanted, rng);
    prepared.helped = true;
  }
  if (wanted != environment.instruction()) environment.set_instruction(wanted);
  if (!pickup_only_ && config_.huddle > 0 && rng.uniform() < config_.huddle) {
    huddle(environment, rng);
    prepared.helped = true;
  }
  if (!pickup_only_ && config_.stretch > 0 && rng.uniform() < config_.stretch) {
    prepared.stretch = Stretch::draw(rng);
    prepared.helped = true;
  }
  if (half_done_ > 0 && can_be_half_done(wanted) && rng.uniform() < half_done_) {
    prepared.helped = half_do(environment, rng) || prepared.helped;
  }
  return prepared;
}

void Curriculum::observe(const std::vector<Outcome>& outcomes, std::int64_t frames) {
  for (const auto& outcome : outcomes) {
    if (outcome.verb == Verb::go_to) go_to_.add(outcome.success);
    if (outcome.verb == Verb::pickup) pickup_.add(outcome.success);
  }
  const bool known = pickup_.size == kWindow;
  if (pickup_only_ && known && pickup_.rate() >= config_.pickup_until) pickup_only_ = false;
  if (config_.balance && !pickup_only_) {
    const double g = go_to_.rate(), p = pickup_.rate();
    go_to_share_ = std::clamp((1.02 - g) / (2.04 - g - p), 0.2, 0.8);
  }
  half_done_ = optim::linear(config_.half_done_start, config_.half_done_end,
                             static_cast<double>(frames), config_.half_done_frames);
}

std::vector<double> Curriculum::state() const {
  std::vector<double> s{pickup_only_ ? 1.0 : 0.0, go_to_share_, half_done_};
  for (const Window* w : {&go_to_, &pickup_}) {
    s.push_back(static_cast<double>(w->next));
    s.push_back(static_cast<double>(w->size));
    s.insert(s.end(), w->success.begin(), w->success.end());
  }
  return s;
}

void Curriculum::restore(const std::vector<double>& state) {
  require(state.size() == 3 + 2 * (2 + kWindow), "Curriculum: a state has {} numbers, got {}",
          3 + 2 * (2 + kWindow), state.size());
  std::size_t k = 0;
  const auto next = [&](double high) {  // NaN is in no range
    require(state[k] >= 0 && state[k] <= high,
            "Curriculum: number {} of a state is {}; expected 0 to {}", k, state[k], high);
    return state[k++];
  };
  const auto whole = [&](std::size_t high) {
    const double value = next(static_cast<double>(high));
    require(std::trunc(value) == value,
            "Curriculum: number {} of a state is {}; expected a whole number", k - 1, value);
    return static_cast<std::size_t>(value);
  };
  Curriculum restored(config_);
  restored.pickup_only_ = whole(1) != 0;
  restored.go_to_share_ = next(1);
  restored.half_done_ = next(1);
  for (Window* w : {&restored.go_to_, &restored.pickup_}) {
    w->next = whole(kWindow - 1);
    w->size = whole(kWindow);
    for (auto& s : w->success) s = static_cast<std::uint8_t>(whole(1));
  }
  *this = std::move(restored);
}

}  // namespace wordgaze::training
