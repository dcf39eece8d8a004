#include "wordgaze/bot/reach.hpp"

#include <algorithm>

namespace wordgaze::bot {

using grid::Position;
using grid::Type;
using grid::World;

namespace {

bool can_cross(const grid::Object& object, Through through) {
  switch (object.type) {
    case Type::empty:
      return true;
    case Type::wall:
      return false;
    case Type::door:
      return object.state == grid::DoorState::open;
    default:
      return through == Through::objects;
  }
}

}  // namespace

void Reach::search(const World& world, const Seen& seen) {
  width_ = world.grid.width();
  cells_.clear();
  reached_.assign(static_cast<std::size_t>(width_ * world.grid.height()), false);
  visit(world.agent, forward(world.direction), 0, 0);
  for (int k = 0; k < static_cast<int>(cells_.size()); ++k) {
    leave(world, seen, k, cells_[k].heading, Through::free_cells);
  }
  free_ = static_cast<int>(cells_.size());
  // The second search starts from all cells of the first; the reference has it head right there.
  for (int k = 0; k < static_cast<int>(cells_.size()); ++k) {
    const Position heading = k < free_ ? forward(grid::Direction::right) : cells_[k].heading;
    leave(world, seen, k, heading, Through::objects);
  }
}

void Reach::visit(Position position, Position heading, int from, int steps) {
  const auto cell = static_cast<std::size_t>(position.y * width_ + position.x);
  if (reached_[cell]) return;
  reached_[cell] = true;
  cells_.push_back({.position = position, .heading = heading, .from = from, .steps = steps});
}

// Visits the neighbors of a cell, straight ahead first and behind last.
void Reach::leave(const World& world, const Seen& seen, int k, Position heading, Through through) {
  const Cell cell = cells_[k];
  if (!seen[cell.position] || !can_cross(world.object_at(cell.position), through)) return;
  const Position aside{heading.y, heading.x};
  for (const Position step : {heading, aside, Position{} - aside, Position{} - heading}) {
    visit(cell.position + step, step, k, cell.steps + 1);
  }
}

std::optional<Route> Reach::route(Position goal) const {
  const auto cell = std::find_if(cells_.begin(), cells_.end(),
                                 [goal](const Cell& c) { return c.position == goal; });
  if (cell == cells_.end()) return std::nullopt;
  int k = static_cast<int>(cell - cells_.begin());
  const bool through_objects = k >= free_;
  while (cells_[k].steps > 1) k = cells_[k].from;
  return Route{
      .steps = cell->steps, .first = cells_[k].position, .through_objects = through_objects};
}

}  // namespace wordgaze::bot
