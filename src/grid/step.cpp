#include "wordgaze/grid/step.hpp"

namespace wordgaze::grid {
namespace {

void drop(World& world, Position front) {
  if (world.carried == kNothing || world.grid[front] != kNothing) return;
  world.put(world.carried, front);
  world.carried = kNothing;
}

void toggle(World& world, Position front) {
  const ObjectId id = world.grid[front];
  const Object& object = world.object(id);
  if (object.type == Type::box) {
    world.put(object.contents, front);
  } else if (object.type == Type::door) {
    const Object& key = world.object(world.carried);
    switch (object.state) {
      case DoorState::open:
        world.set_door(id, DoorState::closed);
        break;
      case DoorState::closed:
        world.set_door(id, DoorState::open);
        break;
      case DoorState::locked:
        if (key.type == Type::key && key.color == object.color) {
          world.set_door(id, DoorState::open);
        }
        break;
    }
  }
}

}  // namespace

void take(World& world, Position from) {
  const ObjectId id = world.grid[from];
  if (world.carried != kNothing || !can_be_carried(world.object(id))) return;
  world.carried = id;
  world.carried_from = from;
  world.objects[id].position = kNowhere;
  world.grid[from] = kNothing;
}

Events step(World& world, Action action) {
  ++world.step_count;
  const Position front = world.front();
  Events events;
  switch (action) {
    case Action::left:
      world.direction = turned(world.direction, -1);
      break;
    case Action::right:
      world.direction = turned(world.direction, 1);
      break;
    case Action::forward: {
      const Object& object = world.object_at(front);
      if (can_be_entered(object)) world.agent = front;
      events.reached_goal = object.type == Type::goal;
      events.entered_lava = object.type == Type::lava;
      break;
    }
    case Action::pickup:
      take(world, front);
      break;
    case Action::drop:
      drop(world, front);
      break;
    case Action::toggle:
      toggle(world, front);
      break;
    case Action::done:
      break;
  }
  return events;
}

}  // namespace wordgaze::grid
