#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "needs.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {
namespace {

constexpr int kMostSteps = 1'000'000'000;
constexpr int kMostObjects = grid::kMaxObjects - 2;
// In larger rooms a chain of six hardly ever fits its grid.
constexpr int kLargestOfChain = 12;

class Checker {
 public:
  explicit Checker(const LevelSpec& level) : level_(level), needs_(needs_of(level.generate)) {}

  void run() {
    require(level_.generate != nullptr, "level '{}' has no generator", level_.id);
    check_rooms();
    check_rules();
    check_kind();
    check_capacity();
    std::visit([&](const auto& parameters) { check(parameters); }, level_.parameters);
  }

 private:
  static std::string_view kind_name(std::size_t kind) {
    constexpr std::array<std::string_view, std::variant_size_v<Parameters>> kNames{
        "none",      "Objects",   "OneRoomTask",    "Missions", "Doors", "Crossings",
        "MultiRoom", "Obstacles", "ObstructedDoor", "Maze",     "Plan"};
    return kNames[kind];
  }

  void within(std::string_view field, int value, int low, int high) const {
    require(value >= low && value <= high, "level '{}': {} = {}; expected {}", level_.id, field,
            value, low == high ? std::to_string(low) : formatted("{} to {}", low, high));
  }

  void check_kind() const {
    if (needs_.kind == kAnyKind) return;
    require(needs_.kind == level_.parameters.index(),
            "level '{}': its generator wants {}, its parameters are {}", level_.id,
            kind_name(needs_.kind), kind_name(level_.parameters.index()));
  }

  void check_rooms() const {
    constexpr int kMaxRooms = grid::RoomGrid::kMaxRooms;
    within("room_size", level_.room_size, needs_.smallest, needs_.largest);
    within("columns", level_.columns, needs_.columns, needs_.most_columns);
    within("rows", level_.rows, needs_.rows, kMaxRooms);
    within("columns * rows", level_.columns * level_.rows, needs_.fewest, needs_.most);
    if (needs_.square) within("rows", level_.rows, level_.columns, level_.columns);
    const int side = (level_.room_size - 1) * std::max(level_.columns, level_.rows) + 1;
    within("cells along a side of the grid", side, 3, kMaxGridSide);
  }

  void check_rules() const {
    const auto index = [](auto value) { return static_cast<int>(value); };
    within("done_mode", index(level_.done_mode), 0, index(DoneMode::sequential));
    within("rule", index(level_.rule), 0, index(Rule::dynamic_obstacles));
    within("actions", level_.actions, 1, grid::kActions);
    // Only an instruction has a step limit of its own.
    within("max_steps", level_.max_steps, level_.rule == Rule::instruction ? 0 : 1, kMostSteps);
  }

  void check_capacity() const {
    require(objects_left(level_) >= 0,
            "level '{}': {} x {} rooms have more doors and objects than a world can hold",
            level_.id, level_.columns, level_.rows);
  }

  void check_objects(std::string_view field, int count) const {
    const auto [low, high] = object_limits(level_);
    require(low <= high, "level '{}': {} x {} rooms with room_size = {} cannot hold its objects",
            level_.id, level_.columns, level_.rows, level_.room_size);
    within(field, count, low, high);
  }

  void check(std::monostate) const {}
  void check(const Objects& p) const { check_objects("objects", p.count); }
  void check(const OneRoomTask& p) const {
    within("clauses", p.clauses, 1, Instruction::kMaxClauses);
    check_objects("objects", p.objects);
  }
  void check(const Missions& p) const {
    check_objects("objects", p.objects);
    require(p.locked_room >= 0 && p.locked_room <= 1,
            "level '{}': locked_room = {}; expected a probability", level_.id, p.locked_room);
    const bool rooms = level_.columns * level_.rows > 1;
    require(rooms || p.locked_room == 0, "level '{}': locked_room = {}; expected 0 in one room",
            level_.id, p.locked_room);
    check_list("verbs", p.verbs, Verb::put_next);
    check_list("forms", p.forms, Form::ordered);
    require(rooms || std::any_of(p.verbs.begin(), p.verbs.end(),
                                 [](Verb verb) { return verb != Verb::open; }),
            "level '{}': verbs are \"open\" alone; expected others in one room, which has no doors",
            level_.id);
  }
  template <class E>
  void check_list(std::string_view field, const std::vector<E>& list, E last) const {
    require(!list.empty(), "level '{}': {} is empty; expected something to draw", level_.id, field);
    for (const E entry : list) within(field, static_cast<int>(entry), 0, static_cast<int>(last));
  }
  void check(const Doors& p) const { within("doors", p.count, 2, 4); }
  void check(const Crossings& p) const {
    within("rivers", p.rivers, 1, std::max(1, 2 * ((level_.room_size - 3) / 2)));
  }
  void check(const MultiRoom& p) const {
    within("rooms", p.rooms, 1, MultiRoom::kMaxRooms);
    within("largest", p.largest, 4, kLargestOfChain);
  }
  void check(const Obstacles& p) const {
    within("obstacles", p.count, 1, std::min(level_.room_size / 2 + 1, kMostObjects - 1));
  }
  void check(const ObstructedDoor&) const {}
  void check(const Maze& p) const {
    within("agent_column", p.agent_column, 0, level_.columns - 1);
    within("agent_row", p.agent_row, 0, level_.rows - 1);
    within("quarters", p.quarters, 1, 4);
  }

  void check(const Plan& p) const {
    within("width of the map", p.width, p.is_map() ? 2 : 0, kMaxGridSide);
    within("height of the map", p.height, p.is_map() ? 1 : 0, p.is_map() ? kMaxGridSide : 0);
    const auto inside = [&](grid::Position at) {
      return at.x >= 0 && at.x < p.width && at.y >= 0 && at.y < p.height;
    };
    std::size_t objects = p.objects.size();
    for (const Plan::Cell& cell : p.cells) {
      require(inside(cell.place), "level '{}': its map has a cell at ({}, {}) outside of it",
              level_.id, cell.place.x, cell.place.y);
      const auto type = cell.thing.type.value_or(grid::Type::key);
      objects += type == grid::Type::door || (type >= grid::Type::key && type <= grid::Type::box);
    }
    require(!p.agent || inside(*p.agent), "level '{}': its agent stands outside of the map",
            level_.id);
    require(objects <= static_cast<std::size_t>(objects_left(level_)),
            "level '{}': {} doors, keys, balls and boxes; a world holds at most {}{}", level_.id,
            objects, objects_left(level_), p.is_map() ? "" : " besides the doors of its rooms");
    const bool goal = level_.rule != Rule::instruction;
    require(goal == p.missions.empty(), "level '{}': {}", level_.id,
            goal ? "its rule is not the instruction, so it takes no missions" : "has no missions");
  }

  const LevelSpec& level_;
  const Needs needs_;
};

}  // namespace

void validate(const LevelSpec& level) { Checker(level).run(); }

}  // namespace wordgaze::babyai
