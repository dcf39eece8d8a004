#include "wordgaze/babyai/verifier.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace wordgaze::babyai {

using grid::Action;
using grid::ObjectId;
using grid::ObjectSet;
using grid::Position;
using grid::World;

void Verifier::begin(const World& world, const Instruction& instruction, DoneMode mode) {
  mode_ = mode;
  clauses_ = static_cast<std::uint8_t>(instruction.clauses());
  completed_.fill(0);
  matched_.fill(0);
  held_.fill(grid::kNothing);
  refresh(world);
  update_turns(instruction);
}

void Verifier::refresh(const World& world) {
  seen_ = 0;
  for (std::size_t k = grid::kWall + 1; k < world.objects.size(); ++k) {
    const auto id = static_cast<ObjectId>(k);
    if (world.stands(id)) seen_ |= grid::only(id);
  }
}

bool Verifier::is_sound(const World& world, const Instruction& instruction, DoneMode mode) const {
  if (mode_ != mode || clauses_ != instruction.clauses()) return false;
  for (int k = 0; k < kMax; ++k) {
    const int most = k < clauses_ ? 1 : 0;
    if (completed_[k] > most || matched_[k] > most) return false;
    if (held_[k] == grid::kNothing) continue;
    const bool thing = held_[k] < world.objects.size() && can_be_carried(world.object(held_[k]));
    if (most == 0 || !thing) return false;
  }
  const ObjectSet walls = grid::only(grid::kNothing) | grid::only(grid::kWall);
  const bool all = world.objects.size() >= grid::kMaxObjects;
  const ObjectSet things =
      (all ? ~ObjectSet{0} : grid::only(static_cast<ObjectId>(world.objects.size())) - 1) & ~walls;
  Verifier turns = *this;
  turns.update_turns(instruction);
  return (seen_ & ~things) == 0 && turns.declarable_ == declarable_;
}

Status Verifier::verify(const World& world, const Task& task, Action action) {
  return mode_ == DoneMode::sequential ? verify_sequential(world, task, action)
                                       : verify_in_order(world, task, action);
}

void Verifier::mark_completed(const Instruction& instruction, int clause) {
  completed_[clause] = 1;
  update_turns(instruction);
}

bool Verifier::completed(Part part) const {
  return std::all_of(completed_.begin() + part.begin, completed_.begin() + part.end,
                     [](std::uint8_t done) { return done != 0; });
}

void Verifier::update_turns(const Instruction& instruction) {
  Part turn = instruction.first();
  while (turn.size() > 0 && completed(turn)) turn = instruction.next(turn);
  declarable_.fill(0);
  for (int k = turn.begin; k < turn.end; ++k) declarable_[k] = !completed_[k];
}

Status Verifier::verify_sequential(const World& world, const Task& task, Action action) {
  if (action != Action::done) {
    for (int k = 0; k < clauses_; ++k) {
      if (declarable_[k]) matched_[k] = check(world, task, action, k) == Status::success;
    }
    return Status::ongoing;
  }
  bool declared = false;
  for (int k = 0; k < clauses_; ++k) {
    if (!declarable_[k] || !matched_[k]) continue;
    mark_completed(task.instruction, k);
    declared = true;
  }
  if (!declared) return Status::failure;
  // What comes next must match on a later action: a match seen earlier does not count.
  matched_.fill(0);
  return completed({0, clauses_}) ? Status::success : Status::ongoing;
}

Status Verifier::verify_in_order(const World& world, const Task& task, Action action) {
  const Instruction& instruction = task.instruction;
  Part part = instruction.first();
  Part next = instruction.next(part);
  if (next.size() == 0) return verify_part(world, task, action, part);
  for (; next.size() > 0; part = next, next = instruction.next(next)) {
    if (completed(part)) continue;
    const Status status = verify_part(world, task, action, part);
    if (status == Status::failure) return status;
    if (status != Status::success) {
      const bool out_of_order = instruction.strict && any_succeeds(world, task, action, next);
      return out_of_order ? Status::failure : Status::ongoing;
    }
    // The action that completes a part may complete the next one as well.
  }
  const Status status = verify_part(world, task, action, part);
  return status == Status::none ? Status::ongoing : status;
}

// Whether an action makes a part true, or one that is to be done after it.
bool Verifier::any_succeeds(const World& world, const Task& task, Action action, Part part) {
  for (; part.size() > 0; part = task.instruction.next(part)) {
    if (verify_part(world, task, action, part) == Status::success) return true;
  }
  return false;
}

Status Verifier::verify_part(const World& world, const Task& task, Action action, Part part) {
  if (part.size() == 1) {
    const Status status = verify_clause(world, task, action, part.begin);
    if (status == Status::success) mark_completed(task.instruction, part.begin);
    return status;
  }
  int failures = 0;
  for (int k = part.begin; k < part.end; ++k) {
    if (completed_[k]) continue;
    const Status status = verify_clause(world, task, action, k);
    if (status == Status::success) mark_completed(task.instruction, k);
    failures += status == Status::failure;
  }
  // A failure of one clause is ignored; so are failures of both, but for one case.
  if (mode_ == DoneMode::exact_enum && action == Action::done && failures == 2) {
    return Status::failure;
  }
  return completed(part) ? Status::success : Status::ongoing;
}

Status Verifier::verify_clause(const World& world, const Task& task, Action action, int k) {
  if (mode_ == DoneMode::off) return check(world, task, action, k);
  if (action == Action::done) return matched_[k] ? Status::success : Status::failure;
  matched_[k] = check(world, task, action, k) == Status::success;
  return Status::none;
}

Status Verifier::check(const World& world, const Task& task, Action action, int k) {
  const Clause& clause = task.instruction.clause[k];
  const Meaning& meaning = task.meaning;
  const ObjectSet wanted = meaning.object[k];
  const ObjectId held = std::exchange(held_[k], world.carried);
  switch (clause.verb) {
    case Verb::go_to:
      return stood_at(world, meaning, clause.object, wanted, world.front()) ? Status::success
                                                                            : Status::ongoing;
    case Verb::open: {
      if (action != Action::toggle) return Status::ongoing;
      const ObjectId id = world.grid[world.front()];
      const grid::Object& object = world.object(id);
      if (object.type != grid::Type::door) return Status::ongoing;
      if (object.state == grid::DoorState::open && (wanted & grid::only(id)) != 0) {
        return Status::success;
      }
      return clause.strict ? Status::failure : Status::ongoing;
    }
    case Verb::pickup:
      if (action != Action::pickup || world.carried == grid::kNothing) return Status::ongoing;
      if (held == grid::kNothing && (wanted & grid::only(world.carried)) != 0)
        return Status::success;
      return clause.strict ? Status::failure : Status::ongoing;
    case Verb::put_next: {
      if (clause.strict && action == Action::pickup && world.carried != grid::kNothing) {
        return Status::failure;
      }
      if (action != Action::drop || held == grid::kNothing || (wanted & grid::only(held)) == 0) {
        return Status::ongoing;
      }
      const Position p = world.object(held).position;
      const bool beside =
          std::any_of(grid::kForward.begin(), grid::kForward.end(), [&](Position step) {
            return stood_at(world, meaning, clause.next_to, meaning.next_to[k], p + step);
          });
      return beside ? Status::success : Status::ongoing;
    }
  }
  return Status::ongoing;
}

// Whether one of the objects meant by a description was last seen at a position.
bool Verifier::stood_at(const World& world, const Meaning& meaning, const Description& description,
                        ObjectSet meant, Position p) const {
  for (ObjectSet left = meant & seen_; left != 0; left &= left - 1) {
    if (world.last_place(static_cast<ObjectId>(std::countr_zero(left))) == p) return true;
  }
  return (meant & grid::only(grid::kWall)) != 0 && world.grid.contains(p) &&
         world.grid[p] == grid::kWall &&
         lies(p, description.location, meaning.agent, meaning.direction);
}

}  // namespace wordgaze::babyai
