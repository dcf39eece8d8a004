#include "rules.hpp"

#include "wordgaze/grid/builder.hpp"
#include "wordgaze/grid/step.hpp"

namespace wordgaze::env {

using babyai::Rule;
using babyai::Task;
using grid::Action;
using grid::DoorState;
using grid::kNothing;
using grid::Object;
using grid::ObjectId;
using grid::Position;
using grid::Type;
using grid::World;

double reward(const World& world, const Task& task) {
  return 1 - 0.9 * (static_cast<double>(world.step_count) / task.max_steps);
}

namespace {

bool same_kind(const Object& a, const Object& b) { return a.type == b.type && a.color == b.color; }

bool is_open(const World& world, ObjectId door) {
  return world.object(door).state == DoorState::open;
}

// Each ball moves to a free cell around it, if one is found.
void move_obstacles(World& world, core::Rng& rng, ObjectId first) {
  constexpr int kTries = 100;
  grid::Builder builder(world, rng);
  for (ObjectId id = first; id < world.objects.size(); ++id) {
    const Position from = world.object(id).position;
    try {
      builder.place(id, from - Position{1, 1}, 3, 3, kTries);
      world.grid[from] = kNothing;
    } catch (const grid::Rejected&) {
      // It stays where it is.
    }
  }
}

}  // namespace

Transition step_by_rule(Rule rule, World& world, const Task& task, core::Rng& rng, Action action) {
  const babyai::Target& target = task.target;
  const ObjectId carried_before = world.carried;
  const bool red_before = is_open(world, target.object), blue_before = is_open(world, target.other);
  const Type ahead = world.object_at(world.front()).type;

  if (rule == Rule::memory && action == Action::pickup) action = Action::toggle;
  if (rule == Rule::dynamic_obstacles) move_obstacles(world, rng, target.object);
  const grid::Events events = step(world, action);

  Transition result{.truncated = world.step_count >= task.max_steps};
  const auto end = [&](bool success) {
    result.terminated = true;
    result.reward = success ? reward(world, task) : 0;
  };
  if (events.reached_goal) end(true);
  if (events.entered_lava) end(false);

  const Position front = world.front();
  switch (rule) {
    case Rule::instruction:
    case Rule::goal:
      break;
    case Rule::fetch:
      if (world.carried != kNothing) {
        end(same_kind(world.object(world.carried), world.object(target.object)));
      }
      break;
    case Rule::reach_and_declare:
      if (action == Action::toggle) end(false);
      if (action == Action::done) end(manhattan(world.agent, target.place) == 1);
      break;
    case Rule::put_near:
      if (action == Action::pickup && world.carried != kNothing &&
          !same_kind(world.object(world.carried), world.object(target.object))) {
        end(false);
      }
      if (action == Action::drop && carried_before != kNothing) {
        end(world.grid[front] == carried_before && is_near(front, target.place));
      }
      break;
    case Rule::pick_up_target:
      if (action == Action::pickup && world.carried == target.object) end(true);
      break;
    case Rule::open_target:
      if (action == Action::toggle && is_open(world, target.object)) end(true);
      break;
    case Rule::red_then_blue:
      if (is_open(world, target.other)) {
        end(red_before);
      } else if (is_open(world, target.object) && blue_before) {
        end(false);
      }
      break;
    case Rule::memory:
      if (world.agent == target.place) end(true);
      if (world.agent == target.trap) end(false);
      break;
    case Rule::dynamic_obstacles:
      if (action == Action::forward && ahead != Type::empty && ahead != Type::goal) {
        result.terminated = true;
        result.reward = -1;
      }
      break;
  }
  return result;
}

}  // namespace wordgaze::env
