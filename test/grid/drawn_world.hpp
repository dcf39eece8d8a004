#pragma once
#include <stdexcept>
#include <string_view>
#include <vector>

#include "wordgaze/grid/world.hpp"

namespace wordgaze::grid {

/// A world from a drawing, one string a row: '#' wall, '.' empty, 'K' 'B' 'X' a red key, ball or
/// box, 'k' 'b' 'x' a blue one, 'o' 'c' 'l' a red door (open, closed, locked), 'G' goal, '~' lava,
/// and the agent as '>' 'v' '<' '^'. Objects are numbered from 2 in reading order.
inline World drawn(const std::vector<std::string_view>& rows) {
  World world;
  world.clear(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  const auto put = [&](Position p, Type type, Color color, DoorState state = DoorState::open) {
    world.put(world.add(type, color, state), p);
  };
  const auto agent = [&](Position p, Direction d) {
    world.agent = p;
    world.direction = d;
  };
  for (int y = 0; y < world.grid.height(); ++y) {
    for (int x = 0; x < world.grid.width(); ++x) {
      const Position p = at(x, y);
      switch (rows[y][x]) {
        case '.':
          break;
        case '#':
          world.put(kWall, p);
          break;
        case 'K':
          put(p, Type::key, Color::red);
          break;
        case 'B':
          put(p, Type::ball, Color::red);
          break;
        case 'X':
          put(p, Type::box, Color::red);
          break;
        case 'k':
          put(p, Type::key, Color::blue);
          break;
        case 'b':
          put(p, Type::ball, Color::blue);
          break;
        case 'x':
          put(p, Type::box, Color::blue);
          break;
        case 'o':
          put(p, Type::door, Color::red, DoorState::open);
          break;
        case 'c':
          put(p, Type::door, Color::red, DoorState::closed);
          break;
        case 'l':
          put(p, Type::door, Color::red, DoorState::locked);
          break;
        case 'G':
          put(p, Type::goal, Color::green);
          break;
        case '~':
          put(p, Type::lava, Color::red);
          break;
        case '>':
          agent(p, Direction::right);
          break;
        case 'v':
          agent(p, Direction::down);
          break;
        case '<':
          agent(p, Direction::left);
          break;
        case '^':
          agent(p, Direction::up);
          break;
        default:
          throw std::invalid_argument("drawn world: what is that?");
      }
    }
  }
  return world;
}

}  // namespace wordgaze::grid
