#include "records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "wordgaze/core/crc32.hpp"

namespace wordgaze::trace {
namespace {

using babyai::Clause;
using babyai::Description;
using babyai::Instruction;
using babyai::Location;
using babyai::Verb;
using env::Environment;
using grid::ObjectId;
using grid::ObjectSet;
using grid::Position;
using grid::World;

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

template <class Visit>
void for_each_cell(const World& world, Visit visit) {
  for (int x = 0; x < world.grid.width(); ++x) {
    for (int y = 0; y < world.grid.height(); ++y) visit(grid::at(x, y));
  }
}

// The whole grid as the reference encodes it: x-major, type, color and state of each cell.
std::vector<std::uint8_t> encoded_grid(const World& world) {
  std::vector<std::uint8_t> bytes;
  grid::write_cells(world, bytes);
  return bytes;
}

std::array<std::uint8_t, grid::kImageBytes> image(const Environment& env) {
  std::array<std::uint8_t, grid::kImageBytes> bytes;
  env.observe(bytes);
  return bytes;
}

Json position(Position p) { return {p.x, p.y}; }

Json object(const World& world, ObjectId id) {
  if (id == grid::kNothing) return nullptr;
  const grid::Object& o = world.object(id);
  return {name(o.type), name(o.color), object(world, o.contents)};
}

Json box_contents(const World& world) {
  Json contents = Json::array();
  for_each_cell(world, [&](Position p) {
    const ObjectId inside = world.object_at(p).contents;
    if (inside != grid::kNothing) contents.push_back({p.x, p.y, object(world, inside)});
  });
  return contents;
}

Json rng(const core::Rng& generator) {
  const auto s = generator.state();
  return {{"state", fmt::format("{:016x}{:016x}", s.state_high, s.state_low)},
          {"inc", fmt::format("{:016x}{:016x}", s.increment_high, s.increment_low)},
          {"has32", int{s.has_half}},
          {"buf32", s.half}};
}

// The objects that a description means, where they stood when the episode began.
Json description(const World& world, const Description& d, ObjectSet meant,
                 const babyai::Meaning& meaning) {
  constexpr std::array<const char*, 5> kLocations{nullptr, "left", "right", "front", "behind"};
  std::vector<std::pair<int, int>> places;
  for (ObjectId id = grid::kWall + 1; id < world.objects.size(); ++id) {
    const Position p = world.object(id).position;
    if ((meant & grid::only(id)) != 0) places.emplace_back(p.x, p.y);
  }
  if ((meant & grid::only(grid::kWall)) != 0) {
    for_each_cell(world, [&](Position p) {
      if (world.grid[p] == grid::kWall && lies(p, d.location, meaning.agent, meaning.direction)) {
        places.emplace_back(p.x, p.y);
      }
    });
  }
  std::sort(places.begin(), places.end());
  const char* location = kLocations[static_cast<int>(d.location)];
  return {{"type", d.type ? Json(name(*d.type)) : Json()},
          {"color", d.color ? Json(name(*d.color)) : Json()},
          {"loc", location != nullptr ? Json(location) : Json()},
          {"n", places.size()},
          {"poss", places}};
}

Json clause(const Environment& env, int k) {
  constexpr std::array kNames{"GoTo", "Pickup", "Open", "PutNext"};
  const Clause& c = env.instruction().clause[k];
  const babyai::Meaning& meaning = env.meaning();
  const Json object = description(env.world(), c.object, meaning.object[k], meaning);
  Json record{{"k", kNames[static_cast<int>(c.verb)]}};
  if (c.verb != Verb::go_to) record["strict"] = c.strict;
  if (c.verb == Verb::put_next) {
    record["move"] = object;
    record["fixed"] = description(env.world(), c.next_to, meaning.next_to[k], meaning);
  } else {
    record["desc"] = object;
  }
  return record;
}

Json part(const Environment& env, Instruction::Part p) {
  if (p.size() == 1) return clause(env, p.begin);
  return {{"k", "And"},
          {"strict", false},
          {"a", clause(env, p.begin)},
          {"b", clause(env, p.begin + 1)}};
}

Json ordered(const Environment& env, const char* kind, const Json& a, const Json& b) {
  return {{"k", kind}, {"strict", env.instruction().strict}, {"a", a}, {"b", b}};
}

// Clauses [begin, end): "A, then (B, then C)".
Json sequence(const Environment& env, int begin, int end) {
  const Instruction::Part first = env.instruction().part_at(begin);
  if (first.end == end) return part(env, first);
  return ordered(env, "Before", part(env, first), sequence(env, first.end, end));
}

Json instruction(const Environment& env) {
  const Instruction& i = env.instruction();
  if (i.clauses() == 0) return nullptr;
  const int after = i.behind_after();
  if (after == 0) return sequence(env, 0, i.clauses());
  return ordered(env, "After", sequence(env, 0, after), sequence(env, after, i.clauses()));
}

}  // namespace

std::uint32_t image_checksum(const Environment& env) { return crc32(image(env)); }

std::uint32_t grid_checksum(const Environment& env) { return crc32(encoded_grid(env.world())); }

Json reset_record(const Environment& env) {
  const World& world = env.world();
  return {{"t", "reset"},
          {"env", env.id()},
          {"mission", env.mission()},
          {"width", world.grid.width()},
          {"height", world.grid.height()},
          {"agent_pos", position(world.agent)},
          {"agent_dir", env.direction()},
          {"max_steps", env.max_steps()},
          {"grid", hex(encoded_grid(world))},
          {"carrying", object(world, world.carried)},
          {"image", hex(image(env))},
          {"direction", env.direction()},
          {"contents", box_contents(world)},
          {"instr", instruction(env)},
          {"rng", rng(env.rng())},
          {"n_actions", env.num_actions()},
          {"see_through", world.see_through_walls},
          {"view", grid::kViewSize}};
}

Json step_record(const Environment& env, grid::Action action, const env::Transition& transition) {
  const World& world = env.world();
  Json record{{"t", "step"},
              {"a", static_cast<int>(action)},
              {"image", hex(image(env))},
              {"direction", env.direction()},
              {"r", transition.reward},
              {"term", transition.terminated},
              {"trunc", transition.truncated},
              {"agent_pos", position(world.agent)},
              {"carrying", object(world, world.carried)},
              {"crc", grid_checksum(env)}};
  if (env.id().starts_with("Wordgaze-")) record["c"] = env.completion();
  return record;
}

}  // namespace wordgaze::trace
