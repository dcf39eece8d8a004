#include "wordgaze/env/environment.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "rules.hpp"
#include "wordgaze/babyai/generator.hpp"
#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/grid/step.hpp"

namespace wordgaze::env {

using babyai::Status;
using grid::Action;

Environment::Environment(std::string_view id) : Environment(babyai::find_level(id)) {}

Environment::Environment(const babyai::LevelSpec& spec)
    : spec_(std::make_shared<const babyai::LevelSpec>(spec)) {
  validate(spec);
}

void Environment::reset(std::uint64_t seed) {
  if (!start(core::Rng(seed))) fail_to_start(std::to_string(seed));
}

void Environment::reset(const core::Seed& seed) {
  if (!start(core::Rng(seed))) fail_to_start(seed.text());
}

void Environment::reset() {
  if (!seeded_) return reset(std::uint64_t{std::random_device{}()});
  reset(rng_);
}

void Environment::reset(const core::Rng& rng) {
  if (!start(rng)) fail_to_start("that of the stream that was continued");
}

void Environment::fail_to_start(const std::string& seed) const {
  throw std::runtime_error(
      formatted("environment '{}': no layout found after many tries; seed: {}", spec_->id, seed));
}

bool Environment::start(core::Rng rng) {
  // Generated aside, so that a failure changes nothing; kept, so that resets do not allocate.
  thread_local grid::World world;
  thread_local babyai::Task task;
  if (!babyai::generate(*spec_, rng, world, task)) return false;
  world_ = world;  // copied, so that it takes no more memory than it needs
  task_ = task;
  rng_ = rng;
  seeded_ = true;
  verifier_.begin(world_, task_.instruction, spec_->done_mode);
  if (task_.start_carrying != grid::kNothing) {
    // As the reference, which does not tell the object that it moved.
    world_.carried = task_.start_carrying;
    world_.carried_from = world_.object(world_.carried).position;
    world_.grid[world_.carried_from] = grid::kNothing;
  }
  return true;
}

void Environment::observe(grid::ImageView image) const {
  if (task_.start_carrying != grid::kNothing && world_.step_count == 0) [[unlikely]] {
    // The reference's first view is older than its world: the object still lies on the floor.
    grid::World before = world_;
    before.put(before.carried, before.object(before.carried).position);
    before.carried = grid::kNothing;
    return grid::observe(before, image);
  }
  grid::observe(world_, image);
}

Transition Environment::step(Action action) {
  require(static_cast<int>(action) < spec_->actions,
          "environment '{}': action {}; expected 0 to {}", spec_->id, static_cast<int>(action),
          spec_->actions - 1);
  if (!seeded_) {
    throw std::logic_error(formatted("environment '{}': step before the first reset", spec_->id));
  }
  return spec_->judge ? step_as_judged(action) : step_as_ruled(action);
}

// What a judge that throws has not seen is taken back.
Transition Environment::step_as_judged(Action action) {
  Environment after = *this;
  Transition transition = after.step_as_ruled(action);
  const babyai::Verdict verdict =
      spec_->judge({.world = after.world_,
                    .task = after.task_,
                    .verifier = after.verifier_,
                    .action = action,
                    .rule = {.reward = transition.reward, .terminated = transition.terminated}});
  if (!std::isfinite(verdict.reward)) {
    throw std::logic_error(
        formatted("environment '{}': its judge gave a reward of {}", spec_->id, verdict.reward));
  }
  transition.reward = verdict.reward;
  transition.terminated = verdict.terminated;
  *this = std::move(after);
  return transition;
}

Transition Environment::step_as_ruled(Action action) {
  if (spec_->rule != babyai::Rule::instruction) {
    return step_by_rule(spec_->rule, world_, task_, rng_, action);
  }
  grid::step(world_, action);
  Transition transition{.truncated = world_.step_count >= task_.max_steps};
  if (action == Action::drop) verifier_.refresh(world_);
  const Status status = verifier_.verify(world_, task_, action);
  if (status == Status::success) transition.reward = reward(world_, task_);
  transition.terminated = status == Status::success || status == Status::failure;
  return transition;
}

void Environment::set_instruction(const babyai::Instruction& instruction) {
  require(spec_->rule == babyai::Rule::instruction,
          "set_instruction: '{}' is not a level of instructions", spec_->id);
  require(instruction.clauses() > 0, "set_instruction: the instruction has no clauses");
  require(is_grammatical(instruction), "set_instruction: the instruction is not of the grammar");
  const babyai::Meaning meaning = look_up(world_, instruction);
  for (int k = 0; k < instruction.clauses(); ++k) {
    require(meaning.object[k] != 0 &&
                (instruction.clause[k].verb != babyai::Verb::put_next || meaning.next_to[k] != 0),
            "set_instruction: nothing in this world matches the description of clause {}", k);
  }
  task_ = {.instruction = instruction,
           .meaning = meaning,
           .sentence = wording(instruction, meaning),
           .max_steps = step_limit(*spec_, instruction)};
  verifier_.begin(world_, instruction, spec_->done_mode);
}

void Environment::move_object(grid::ObjectId id, grid::Position to) {
  require(id < world_.objects.size() && world_.stands(id),
          "move_object: object {} does not stand in the grid", id);
  require(world_.grid.contains(to) && world_.grid[to] == grid::kNothing && to != world_.agent,
          "move_object: cell ({}, {}) is not empty", to.x, to.y);
  world_.grid[world_.object(id).position] = grid::kNothing;
  world_.put(id, to);
}

void Environment::take_object(grid::ObjectId id) {
  require(id < world_.objects.size() && world_.stands(id) &&
              grid::can_be_carried(world_.object(id)) && world_.carried == grid::kNothing,
          "take_object: object {} does not stand in the grid, cannot be carried, or the hand is "
          "not empty",
          id);
  grid::take(world_, world_.object(id).position);
}

void Environment::mark_completed(int clause) {
  const auto turns = verifier_.declarable();
  require(clause >= 0 && clause < static_cast<int>(turns.size()) && turns[clause] != 0,
          "mark_completed: clause {} is not one whose turn it is", clause);
  int left = 0;
  for (std::uint8_t done : verifier_.completion()) left += done == 0;
  require(left > 1, "mark_completed: clause {} is the last one left", clause);
  verifier_.mark_completed(task_.instruction, clause);
}

}  // namespace wordgaze::env
