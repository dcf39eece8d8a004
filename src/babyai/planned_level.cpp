#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/minigrid_stages.hpp"

namespace wordgaze::babyai::generators {
namespace {

using grid::Color;
using grid::ObjectId;
using grid::Type;

constexpr std::array kTypesToDraw{Type::key, Type::ball, Type::box};

class Planner {
 public:
  Planner(Layout& layout, const Plan& plan) : layout_(layout), plan_(plan) {
    for (const Plan::Cell& cell : plan.cells) keep_off(cell.thing);
    for (const Plan::Thing& thing : plan.objects) keep_off(thing);
  }

  void draw() {
    if (plan_.is_map()) {
      draw_map();
    } else {
      draw_rooms();
    }
    if (plan_.missions.empty()) {
      ask(layout_, "get to the green goal square");
    } else {
      const auto drawn = layout_.rng.below(static_cast<int>(plan_.missions.size()));
      ask_for(plan_.missions[static_cast<std::size_t>(drawn)]);
    }
  }

 private:
  /// A bit for each type and color of what can be carried.
  static std::uint32_t kind(Type type, Color color) {
    return 1u << ((static_cast<int>(type) - static_cast<int>(Type::key)) * 6 +
                  static_cast<int>(color));
  }
  /// What is drawn is not to be like what the plan gives.
  void keep_off(const Plan::Thing& thing) {
    const bool given = thing.type && thing.color;
    if (given && *thing.type >= Type::key && *thing.type <= Type::box) {
      kinds_ |= kind(*thing.type, *thing.color);
    }
  }

  void draw_map() {
    layout_.world.clear(plan_.width, plan_.height);
    for (const Plan::Cell& cell : plan_.cells) {
      layout_.world.put(object_for(cell.thing), cell.place);
    }
    // Where the agent will stand is no place for anything else.
    layout_.world.agent = plan_.agent.value_or(grid::kNowhere);
    for (const Plan::Thing& thing : plan_.objects) layout_.place(object_for(thing));
    if (!plan_.agent) return layout_.Builder::place_agent();
    layout_.world.direction =
        plan_.direction ? *plan_.direction : static_cast<grid::Direction>(layout_.rng.below(4));
  }

  void draw_rooms() {
    for (const Plan::Thing& thing : plan_.objects) {
      layout_.place_in_room(object_for(thing), layout_.random_room());
    }
    layout_.place_agent();
    layout_.connect_all();
    layout_.require_reachable();
  }

  /// A new object; walls, floors, lava and goals of one color are one object in many cells.
  ObjectId object_for(const Plan::Thing& thing) {
    const Type type = thing.type ? *thing.type : layout_.pick(kTypesToDraw);
    grid::World& world = layout_.world;
    switch (type) {
      case Type::wall:
        return grid::kWall;
      case Type::goal:
        return shared(type, Color::green);
      case Type::lava:
        return shared(type, Color::red);
      case Type::floor:
        return shared(type, color_for(thing));
      case Type::door:
        return world.add(type, color_for(thing), thing.state);
      default:
        return add_distinct(thing, type);
    }
  }

  Color color_for(const Plan::Thing& thing) { return thing.color ? *thing.color : layout_.color(); }

  ObjectId shared(Type type, Color color) {
    const auto& objects = layout_.world.objects;
    const auto found = std::ranges::find_if(objects, [&](const grid::Object& object) {
      return object.type == type && object.color == color;
    });
    return found != objects.end() ? static_cast<ObjectId>(found - objects.begin())
                                  : layout_.world.add(type, color);
  }

  /// What is drawn is drawn again until it is unlike all that are there.
  ObjectId add_distinct(const Plan::Thing& thing, Type type) {
    constexpr int kTries = 200;
    for (int tries = 0; tries < kTries; ++tries) {
      const Color color = color_for(thing);
      const bool drawn = !thing.type || !thing.color;
      if (!plan_.distinct || !drawn || (kinds_ & kind(type, color)) == 0) {
        kinds_ |= kind(type, color);
        return layout_.world.add(type, color);
      }
      if (!thing.type) type = layout_.pick(kTypesToDraw);
    }
    throw grid::Rejected{};
  }

  void ask_for(const Plan::Mission& mission) {
    layout_.task.instruction = mission.instruction;
    std::vector<Description> named;
    for (const Plan::Mission::Gap& gap : mission.gaps) {
      Clause& clause = layout_.task.instruction.clause[static_cast<std::size_t>(gap.clause)];
      Description& description = gap.next_to ? clause.next_to : clause.object;
      named.push_back(description = something_for(clause, named));
    }
    const Meaning meaning = look_up(layout_.world, layout_.task.instruction);
    for (int k = 0; k < mission.instruction.clauses(); ++k) {
      const bool put_next = mission.instruction.clause[k].verb == Verb::put_next;
      if (meaning.object[k] == 0 || (put_next && meaning.next_to[k] == 0)) throw grid::Rejected{};
    }
  }

  /// One of the things that a clause may be about, unlike those that are named already.
  Description something_for(const Clause& clause, const std::vector<Description>& named) {
    std::vector<Description> fit;
    for (std::size_t k = grid::kWall + 1; k < layout_.world.objects.size(); ++k) {
      const auto id = static_cast<ObjectId>(k);
      const grid::Object& object = layout_.world.object(id);
      const bool door = object.type == Type::door, thing = grid::can_be_carried(object);
      const bool may = clause.verb == Verb::open    ? door
                       : clause.verb == Verb::go_to ? door || thing
                                                    : thing;
      const Description description = layout_.describe(id);
      const bool another = std::ranges::find(named, description) == named.end();
      if (may && another && layout_.world.stands(id)) fit.push_back(description);
    }
    if (fit.empty()) throw grid::Rejected{};
    return fit[static_cast<std::size_t>(layout_.rng.below(static_cast<int>(fit.size())))];
  }

  Layout& layout_;
  const Plan& plan_;
  std::uint32_t kinds_ = 0;  // given, or drawn already
};

}  // namespace

void planned(Layout& layout) { Planner(layout, layout.parameters<Plan>()).draw(); }

}  // namespace wordgaze::babyai::generators
