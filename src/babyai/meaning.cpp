#include "wordgaze/babyai/meaning.hpp"

namespace wordgaze::babyai {
namespace {

using grid::Direction;
using grid::ObjectId;
using grid::ObjectSet;
using grid::Position;
using grid::World;

// The room of the agent, walls included; a shared wall belongs to the room at its right or below.
bool in_room_of_agent(const World& world, Position p) {
  if (world.room_size == 0) return true;
  const int pitch = world.room_size - 1;
  const int x = p.x - world.agent.x / pitch * pitch, y = p.y - world.agent.y / pitch * pitch;
  return x >= 0 && x <= pitch && y >= 0 && y <= pitch;
}

}  // namespace

bool lies(Position p, Location side, Position agent, Direction direction) {
  const Position v = p - agent, ahead = forward(direction);
  const int forth = v.x * ahead.x + v.y * ahead.y;
  const int right = v.y * ahead.x - v.x * ahead.y;
  switch (side) {
    case Location::anywhere:
      return true;
    case Location::left:
      return right < 0;
    case Location::right:
      return right > 0;
    case Location::front:
      return forth > 0;
    case Location::behind:
      return forth < 0;
  }
  return false;
}

ObjectSet matching_objects(const World& world, const Description& d) {
  ObjectSet found = 0;
  for (std::size_t k = grid::kWall; k < world.objects.size(); ++k) {
    const grid::Object& object = world.objects[k];
    const auto id = static_cast<ObjectId>(k);
    if (d.type && object.type != *d.type) continue;
    if (d.color && object.color != *d.color) continue;
    if (id == grid::kWall) {
      found |= grid::only(id);  // there are walls on every side of the agent
      continue;
    }
    if (!world.stands(id)) continue;
    if (d.location != Location::anywhere &&
        !(in_room_of_agent(world, object.position) &&
          lies(object.position, d.location, world.agent, world.direction))) {
      continue;
    }
    found |= grid::only(id);
  }
  return found;
}

Meaning look_up(const World& world, const Instruction& instruction) {
  Meaning meaning{.agent = world.agent, .direction = world.direction};
  for (int k = 0; k < instruction.clauses(); ++k) {
    const Clause& clause = instruction.clause[k];
    meaning.object[k] = matching_objects(world, clause.object);
    if (clause.verb == Verb::put_next) {
      meaning.next_to[k] = matching_objects(world, clause.next_to);
    }
  }
  return meaning;
}

}  // namespace wordgaze::babyai
