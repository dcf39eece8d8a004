#include "wordgaze/babyai/generator.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <variant>

#include "wordgaze/babyai/layout.hpp"
#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/core/formatted.hpp"

namespace wordgaze::babyai {
namespace {

/// Layouts to try, which take longer the larger they are.
int max_layouts(const grid::World& world) {
  constexpr int kMost = 500'000, kCells = 4096;
  const int cells = world.grid.width() * world.grid.height();
  return cells <= kCells ? kMost : static_cast<int>(std::int64_t{kMost} * kCells / cells);
}

// "Put A next to B" must have something left to do.
bool can_be_put(const grid::World& world, grid::ObjectSet objects, grid::ObjectSet next_to) {
  if ((objects & next_to) != 0) return false;
  for (auto a = objects; a != 0; a &= a - 1) {
    for (auto b = next_to; b != 0; b &= b - 1) {
      if (manhattan(world.objects[std::countr_zero(a)].position,
                    world.objects[std::countr_zero(b)].position) == 1) {
        return false;
      }
    }
  }
  return true;
}

// Whether a description asks for a key that a locked door needs.
bool asks_for_needed_key(const grid::World& world, const Description& d) {
  return d.type == grid::Type::key && d.color &&
         std::any_of(world.objects.begin(), world.objects.end(), [&](const grid::Object& object) {
           return object.type == grid::Type::door && object.state == grid::DoorState::locked &&
                  object.color == *d.color;
         });
}

bool is_valid(const Layout& layout, const Task& task) {
  const auto* missions = std::get_if<Missions>(&layout.level.parameters);
  const bool unblocking = missions != nullptr && missions->unblocking;
  for (int k = 0; k < task.instruction.clauses(); ++k) {
    if (task.instruction.clause[k].verb == Verb::put_next &&
        !can_be_put(layout.world, task.meaning.object[k], task.meaning.next_to[k])) {
      return false;
    }
    if (unblocking) {
      const Clause& clause = task.instruction.clause[k];
      if (asks_for_needed_key(layout.world, clause.object) ||
          asks_for_needed_key(layout.world, clause.next_to)) {
        return false;
      }
    }
  }
  return true;
}

// What the rest of the simulator takes for granted, whoever wrote the generator.
void check(const Layout& layout, const Task& task) {
  const LevelSpec& level = layout.level;
  const grid::World& world = layout.world;
  const auto expect = [&](bool ok, const char* what) {
    if (!ok) throw std::logic_error(formatted("level '{}': its generator {}", level.id, what));
  };
  const auto exists = [&](grid::ObjectId id) { return id < world.objects.size(); };
  const Instruction& i = task.instruction;
  expect(world.grid.contains(world.agent), "put the agent nowhere; call place_agent");
  expect(is_grammatical(i), "wrote no instruction of the grammar; use single, both and ordered");
  expect(level.rule != Rule::instruction || i.clauses() > 0, "wrote no instruction");
  expect(exists(task.target.object) && exists(task.target.other), "named a target that is none");
  expect(task.start_carrying == grid::kNothing ||
             (exists(task.start_carrying) && world.stands(task.start_carrying)),
         "lets the agent carry what does not stand in the grid");
  if (level.rule != Rule::dynamic_obstacles) return;
  expect(task.target.object > grid::kWall, "named no obstacle");
  for (std::size_t id = task.target.object; id < world.objects.size(); ++id) {
    expect(world.stands(static_cast<grid::ObjectId>(id)), "left an obstacle out of the grid");
  }
}

// One layout; false when it is rejected.
bool try_layout(const LevelSpec& level, core::Rng& rng, grid::World& world, Task& task) {
  try {
    Layout layout(level, world, rng, task);
    task = {};
    level.generate(layout);
    check(layout, task);
    task.meaning = look_up(world, task.instruction);
    return is_valid(layout, task);
  } catch (const grid::Rejected&) {
    return false;
  }
}

}  // namespace

bool generate(const LevelSpec& level, core::Rng& rng, grid::World& world, Task& task) {
  try {
    int layouts = 1;
    while (!try_layout(level, rng, world, task)) {
      if (++layouts > max_layouts(world)) return false;
    }
  } catch (const grid::GaveUp&) {
    return false;
  }
  world.see_through_walls = level.see_through_walls;
  world.carried = grid::kNothing;
  world.step_count = 0;
  if (level.rule == Rule::instruction) task.sentence = wording(task.instruction, task.meaning);
  task.max_steps = step_limit(level, task.instruction);
  return true;
}

int step_limit(const LevelSpec& level, const Instruction& instruction) {
  if (level.max_steps != 0) return level.max_steps;
  int navigations = 0;
  for (int k = 0; k < instruction.clauses(); ++k) {
    navigations += instruction.clause[k].verb == Verb::put_next ? 2 : 1;
  }
  return navigations * level.room_size * level.room_size * level.rows * level.columns;
}

}  // namespace wordgaze::babyai
