#pragma once
#include <array>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::babyai {

/// Whether a position lies on that side of an agent; `room` is not looked at.
bool lies(grid::Position p, Location side, grid::Position agent, grid::Direction direction);

/// The objects in the grid that a description fits; with a location, only those in the room of the
/// agent. A description without a type also fits walls, as in the reference. (docs/simulator.md,
/// Descriptions)
grid::ObjectSet matching_objects(const grid::World& world, const Description& description);

/// Which objects the descriptions of an instruction mean, from when the episode begins until it
/// ends.
struct Meaning {
  std::array<grid::ObjectSet, Instruction::kMaxClauses> object{}, next_to{};
  /// Where the agent stood: locations are seen from there.
  grid::Position agent{};
  grid::Direction direction = grid::Direction::right;
};

Meaning look_up(const grid::World& world, const Instruction& instruction);

/// Whether a set holds more than one cell's object; walls are one object in many cells.
constexpr bool several(grid::ObjectSet set) {
  return (set & (set - 1)) != 0 || set == grid::only(grid::kWall);
}

}  // namespace wordgaze::babyai
