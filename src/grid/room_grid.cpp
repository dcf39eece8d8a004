#include "wordgaze/grid/room_grid.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::grid {
namespace {

constexpr std::array kTypesToDraw{Type::key, Type::ball, Type::box};
constexpr std::array kSides{Direction::right, Direction::down, Direction::left, Direction::up};
constexpr int kPlacementTries = 1000;
constexpr int kConnectionTries = 5000;
constexpr int kAgentRounds = 100'000;
constexpr std::uint32_t kAllKinds = (1u << (kTypesToDraw.size() * kColorsToDraw.size())) - 1;

constexpr Direction opposite(Direction side) { return turned(side, 2); }
constexpr RoomIndex beyond(RoomIndex room, Direction side) {
  const Position d = forward(side);
  return {room.column + d.x, room.row + d.y};
}

// One bit for each type and color of what can be scattered; none for other objects.
std::uint32_t kind(Type type, Color color) {
  if (type < Type::key || type > Type::box) return 0;
  return 1u << ((static_cast<int>(type) - static_cast<int>(Type::key)) * 6 +
                static_cast<int>(color));
}

}  // namespace

RoomGrid::RoomGrid(World& w, core::Rng& r, int room_size, int columns, int rows)
    : Builder(w, r), size_(room_size), columns_(columns), rows_(rows) {
  require(room_size >= 3, "RoomGrid: room_size = {}; expected at least 3", room_size);
  require(columns >= 1 && rows >= 1 && rows <= kMaxRooms / columns,
          "RoomGrid: {} x {} rooms; expected 1 to {} of them", columns, rows, kMaxRooms);
  const int pitch = room_size - 1;
  world.clear(pitch * columns + 1, pitch * rows + 1);
  world.room_size = room_size;
  for (int j = 0; j <= rows; ++j) world.grid.wall_row(at(0, j * pitch), world.grid.width());
  for (int i = 0; i <= columns; ++i) world.grid.wall_column(at(i * pitch, 0), world.grid.height());

  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      Room& room = at_room({i, j});
      const int x = i * pitch, y = j * pitch;
      if (i < columns - 1) {
        const Position p = at(x + pitch, between(y + 1, y + pitch));
        room.door_positions[int(Direction::right)] = p;
        at_room({i + 1, j}).door_positions[int(Direction::left)] = p;
      }
      if (j < rows - 1) {
        const Position p = at(between(x + 1, x + pitch), y + pitch);
        room.door_positions[int(Direction::down)] = p;
        at_room({i, j + 1}).door_positions[int(Direction::up)] = p;
      }
    }
  }
  world.agent = at(columns / 2 * pitch + room_size / 2, rows / 2 * pitch + room_size / 2);
  world.direction = Direction::right;
}

std::size_t RoomGrid::index(RoomIndex room) const {
  if (room.column < 0 || room.column >= columns_ || room.row < 0 || room.row >= rows_) {
    throw std::out_of_range(
        formatted("room ({}, {}) of {} x {} rooms", room.column, room.row, columns_, rows_));
  }
  return static_cast<std::size_t>(room.row * columns_ + room.column);
}

RoomIndex RoomGrid::random_room() {
  const int column = rng.below(columns_);
  return {column, rng.below(rows_)};
}

RoomIndex RoomGrid::room_of(Position p) const { return {p.x / (size_ - 1), p.y / (size_ - 1)}; }

bool RoomGrid::contains(RoomIndex room, Position p) const {
  const Position inside = p - corner(room);
  return inside.x >= 0 && inside.x < size_ && inside.y >= 0 && inside.y < size_;
}

bool RoomGrid::has_neighbor(RoomIndex room, Direction side) const {
  const RoomIndex next = beyond(room, side);
  return next.column >= 0 && next.column < columns_ && next.row >= 0 && next.row < rows_;
}

void RoomGrid::place_in_room(ObjectId id, RoomIndex room) {
  place(
      id, corner(room), size_, size_, [&](Position p) { return manhattan(p, world.agent) < 2; },
      kPlacementTries);
  const Object& object = world.object(id);
  kinds_ |= kind(object.type, object.color);
}

ObjectId RoomGrid::add_object(RoomIndex room, std::optional<Type> type,
                              std::optional<Color> color) {
  if (!type) type = pick(kTypesToDraw);
  if (!color) color = this->color();
  const ObjectId id = world.add(*type, *color);
  place_in_room(id, room);
  return id;
}

ObjectRange RoomGrid::scatter(std::optional<RoomIndex> room, int count, bool unique) {
  const ObjectRange added{static_cast<ObjectId>(world.objects.size()), count};
  for (int n = 0; n < count;) {
    const Color color = this->color();
    const Type type = pick(kTypesToDraw);
    if (unique && kinds_ == kAllKinds) throw GaveUp{};
    if (unique && (kinds_ & kind(type, color)) != 0) continue;
    add_object(room ? *room : random_room(), type, color);
    ++n;
  }
  return added;
}

ObjectId RoomGrid::add_door(RoomIndex at, std::optional<Direction> side, std::optional<Color> color,
                            std::optional<bool> locked) {
  Room& room = at_room(at);
  const auto is_free = [&](Direction s) { return has_neighbor(at, s) && door(at, s) == kNothing; };
  if (!side && std::none_of(kSides.begin(), kSides.end(), is_free)) throw GaveUp{};
  while (!side) {
    const auto drawn = static_cast<Direction>(rng.below(4));
    if (is_free(drawn)) side = drawn;
  }
  at_room(beyond(at, *side));  // there is one
  if (!color) color = this->color();
  if (!locked) locked = coin();
  room.locked = *locked;  // as the reference: a later unlocked door clears it
  const ObjectId id =
      world.add(Type::door, *color, *locked ? DoorState::locked : DoorState::closed);
  world.put(id, room.door_positions[int(*side)]);
  connect(at, *side, id);
  return id;
}

void RoomGrid::remove_wall(RoomIndex room, Direction side) {
  const Position from = corner(room);
  for (int k = 1; k < size_ - 1; ++k) {
    switch (side) {
      case Direction::right:
        world.grid[from + at(size_ - 1, k)] = kNothing;
        break;
      case Direction::down:
        world.grid[from + at(k, size_ - 1)] = kNothing;
        break;
      case Direction::left:
        world.grid[from + at(0, k)] = kNothing;
        break;
      case Direction::up:
        world.grid[from + at(k, 0)] = kNothing;
        break;
    }
  }
  connect(room, side, kWall);
}

void RoomGrid::connect(RoomIndex room, Direction side, ObjectId by) {
  at_room(room).doors[int(side)] = by;
  at_room(beyond(room, side)).doors[int(opposite(side))] = by;
}

void RoomGrid::place_agent(std::optional<RoomIndex> room) {
  if (!room) room = random_room();
  for (int round = 0; round < kAgentRounds; ++round) {
    Builder::place_agent(corner(*room), size_, size_, kPlacementTries);
    if (world.grid[world.front()] <= kWall) return;
  }
  throw GaveUp{};
}

void RoomGrid::connect_all(std::span<const Color> colors) {
  for (int tries = 0; tries <= kConnectionTries; ++tries) {
    if (all_connected()) return;
    const RoomIndex room = random_room();
    const auto side = static_cast<Direction>(rng.below(4));
    if (!has_neighbor(room, side) || door(room, side) != kNothing) continue;
    if (at_room(room).locked || at_room(beyond(room, side)).locked) continue;
    const Color color = pick(colors);
    add_door(room, side, color, false);
  }
  throw Rejected{};
}

bool RoomGrid::all_connected() const {
  std::array<RoomIndex, kMaxRooms> reached;
  std::uint32_t seen = 0;
  int count = 0;
  const auto reach = [&](RoomIndex room) {
    const std::uint32_t bit = 1u << (room.row * columns_ + room.column);
    if ((seen & bit) != 0) return;
    seen |= bit;
    reached[count++] = room;
  };
  reach(room_of(world.agent));
  for (int k = 0; k < count; ++k) {
    const RoomIndex room = reached[k];
    for (Direction side : kSides) {
      if (door(room, side) != kNothing) reach(beyond(room, side));
    }
  }
  return count == columns_ * rows_;
}

bool RoomGrid::all_reachable() const {
  ObjectSet passable = only(kNothing), standing = 0;
  for (std::size_t k = kWall + 1; k < world.objects.size(); ++k) {
    const auto id = static_cast<ObjectId>(k);
    if (world.object(id).type == Type::door) passable |= only(id);
    if (world.stands(id)) standing |= only(id);
  }

  // Cells that were reached become walls in a copy. Kept between calls: resets do not allocate.
  thread_local Grid left;
  thread_local std::vector<ObjectId*> reached;
  left = world.grid;
  reached.resize(static_cast<std::size_t>(left.width() * left.height()) + 1);
  ObjectSet found = only(world.grid[world.agent]);
  ObjectId** end = reached.data();
  *end++ = left.pointer(world.agent);
  *left.pointer(world.agent) = kWall;
  // Without branches, as nobody could predict them: each neighbor is written, few are kept.
  const auto look_at = [&](ObjectId* cell) {
    const ObjectId id = *cell;
    const bool passes = (passable & only(id)) != 0;
    found |= only(id);
    *cell = passes ? kWall : id;
    *end = cell;
    end += passes;
  };
  const std::ptrdiff_t row = left.stride();
  while (end != reached.data() && (standing & ~found) != 0) {
    ObjectId* cell = *--end;
    for (std::ptrdiff_t step : {std::ptrdiff_t{1}, row, std::ptrdiff_t{-1}, -row}) {
      look_at(cell + step);
    }
  }
  return (standing & ~found) == 0;
}

}  // namespace wordgaze::grid
