#pragma once
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include "wordgaze/bot/seen.hpp"

namespace wordgaze::bot {

/// The way from the agent to a cell.
struct Route {
  int steps = 0;                 ///< cells walked through, the last one included
  grid::Position first;          ///< the first of them; the agent's own cell when there are none
  bool through_objects = false;  ///< something that can be moved lies in the way
};

/// Whether a way may lead through objects that can be moved.
enum class Through : std::uint8_t { free_cells, objects };

/// Where the agent can get to, as far as it has seen: one breadth-first search from where it
/// stands, first through free cells and open doors, then through objects as well. What is closer
/// comes first; of cells equally far, those that need fewer turns. Walls, closed doors, objects and
/// unseen cells are reached, but not crossed.
class Reach {
 public:
  void search(const grid::World& world, const Seen& seen);

  /// The first cell, in the order of the search, that a condition holds for.
  template <std::predicate<grid::Position> Condition>
  std::optional<grid::Position> closest(Through through, const Condition& condition) const {
    const int end = through == Through::objects ? static_cast<int>(cells_.size()) : free_;
    for (int k = 0; k < end; ++k) {
      if (condition(cells_[k].position)) return cells_[k].position;
    }
    return std::nullopt;
  }

  /// The way to a cell, avoiding objects if that is possible; none to what cannot be reached.
  std::optional<Route> route(grid::Position goal) const;

 private:
  struct Cell {
    grid::Position position;
    grid::Position heading;  // the step that led there
    int from;                // index of the cell before
    int steps;
  };

  void visit(grid::Position position, grid::Position heading, int from, int steps);
  void leave(const grid::World& world, const Seen& seen, int k, grid::Position heading, Through);

  int width_ = 0;
  std::vector<Cell> cells_;    // in the order of the search
  int free_ = 0;               // so many of them are reached through free cells
  std::vector<bool> reached_;  // by cell of the grid
};

}  // namespace wordgaze::bot
