#include "drop_place.hpp"

#include <array>

namespace wordgaze::bot {

using grid::Position;
using grid::World;

namespace {

// What a cell means to those who walk by.
enum class Use : std::uint8_t { walkable, wall, occupied };

// The eight neighbors of a cell, around it.
constexpr std::array<Position, 8> kAround{
    {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};

class Site {
 public:
  Site(const World& world, const Seen& seen, std::optional<Position> reserved)
      : world_(world), seen_(seen), reserved_(reserved) {}

  bool is_free(Position p) const {
    return p != world_.agent && p != reserved_ && seen_[p] && world_.grid[p] == grid::kNothing;
  }

  // Free, and the walkable cells around it stay connected, and what is around it can be reached.
  bool is_out_of_the_way(Position p) const {
    if (!is_free(p)) return false;
    std::array<Use, 8> around;
    for (int k = 0; k < 8; ++k) around[k] = use(p + kAround[k]);
    int changes = 0;
    for (int k = 0; k < 8; ++k) {
      const bool walkable = around[k] == Use::walkable;
      const bool next = around[(k + 1) % 8] == Use::walkable;
      const bool previous = around[(k + 7) % 8] == Use::walkable;
      if (around[k] == Use::occupied && !previous && !next) return false;
      changes += walkable != next;
    }
    return changes <= 2;
  }

 private:
  Use use(Position p) const {
    const grid::Object& object = world_.object_at(p);
    if (!seen_[p]) return Use::occupied;
    if (object.type == grid::Type::wall) return Use::wall;
    const bool is_open_door =
        object.type == grid::Type::door && object.state == grid::DoorState::open;
    const bool can_be_walked =
        object.type == grid::Type::empty || is_open_door || p == world_.agent;
    return can_be_walked && p != reserved_ ? Use::walkable : Use::occupied;
  }

  const World& world_;
  const Seen& seen_;
  std::optional<Position> reserved_;
};

}  // namespace

std::optional<Position> find_drop_place(const World& world, const Seen& seen, const Reach& reach,
                                        std::optional<Position> reserved) {
  const Site site(world, seen, reserved);
  for (const Through through : {Through::free_cells, Through::objects}) {
    const auto good = reach.closest(through, [&](Position p) { return site.is_out_of_the_way(p); });
    if (good) return good;
    const auto free = reach.closest(through, [&](Position p) { return site.is_free(p); });
    if (free) return free;
  }
  return std::nullopt;
}

}  // namespace wordgaze::bot
