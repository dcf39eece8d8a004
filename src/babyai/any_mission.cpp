#include <bit>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/stages.hpp"

// BabyAI's LevelGen: a maze of rooms, one of them perhaps locked, and any instruction of the
// grammar. (docs/simulator.md, Levels)
namespace wordgaze::babyai::generators {

using grid::Color;
using grid::Direction;
using grid::ObjectId;
using grid::ObjectSet;
using grid::RoomIndex;
using grid::Type;

namespace {

constexpr int kDescriptionTries = 100;

class MissionGenerator {
 public:
  explicit MissionGenerator(Layout& layout)
      : layout_(layout), wanted_(layout.parameters<Missions>()) {}

  void run() {
    if (layout_.rng.uniform() < wanted_.locked_room) add_locked_room();
    layout_.connect_all();
    layout_.scatter(std::nullopt, wanted_.objects, false);
    do {
      layout_.place_agent();
    } while (locked_room_ && layout_.room_of(layout_.world.agent) == *locked_room_);
    if (!wanted_.unblocking) layout_.require_reachable();
    layout_.task.instruction = draw_instruction(wanted_.forms);
  }

 private:
  void add_locked_room() {
    RoomIndex room;
    Direction side{};
    do {
      room = layout_.random_room();
      side = static_cast<Direction>(layout_.rng.below(4));
    } while (!layout_.has_neighbor(room, side));
    locked_room_ = room;
    const ObjectId door = layout_.add_door(room, side, {}, true);
    RoomIndex of_key;
    do {
      of_key = layout_.random_room();
    } while (of_key == room);
    add_key(layout_, of_key, door);
  }

  Instruction draw_instruction(std::span<const Form> forms) {
    constexpr std::array kUnordered{Form::clause, Form::both};
    constexpr std::array kOrders{Order::before, Order::after};
    switch (layout_.pick(forms)) {
      case Form::clause:
        return single(draw_clause());
      case Form::both: {
        const Clause a = draw_clause();
        return both(a, draw_clause());
      }
      case Form::ordered: {
        const Instruction a = draw_instruction(kUnordered);
        const Instruction b = draw_instruction(kUnordered);
        return ordered(a, layout_.pick(kOrders), b);
      }
    }
    return {};
  }

  Clause draw_clause() {
    static constexpr std::array kAll{Type::box, Type::ball, Type::key, Type::door};
    constexpr std::span<const Type> kMovable = std::span(kAll).first<3>();
    constexpr std::span<const Type> kDoor = std::span(kAll).last<1>();
    Clause clause{.verb = layout_.pick(std::span(wanted_.verbs))};
    switch (clause.verb) {
      case Verb::go_to:
        clause.object = draw_description(kAll);
        break;
      case Verb::pickup:
        clause.object = draw_description(kMovable);
        break;
      case Verb::open:
        clause.object = draw_description(kDoor);
        break;
      case Verb::put_next:
        clause.object = draw_description(kMovable);
        clause.next_to = draw_description(kAll);
        break;
    }
    return clause;
  }

  // A description that fits something.
  Description draw_description(std::span<const Type> types) {
    constexpr std::array<std::optional<Color>, 7> kColors{std::nullopt, Color::blue,   Color::green,
                                                          Color::grey,  Color::purple, Color::red,
                                                          Color::yellow};
    constexpr std::array kLocations{Location::left, Location::right, Location::front,
                                    Location::behind};
    for (int tries = 0; tries <= kDescriptionTries; ++tries) {
      Description d;
      d.color = layout_.pick(kColors);
      d.type = layout_.pick(types);
      if (wanted_.locations && layout_.coin()) d.location = layout_.pick(kLocations);
      const ObjectSet meant = matching_objects(layout_.world, d);
      if (meant == 0) continue;
      if (!wanted_.implicit_unlock && locked_room_ && all_locked_in(meant)) continue;
      return d;
    }
    throw grid::Rejected{};
  }

  bool all_locked_in(ObjectSet objects) const {
    for (; objects != 0; objects &= objects - 1) {
      const grid::Object& object = layout_.world.objects[std::countr_zero(objects)];
      if (!layout_.contains(*locked_room_, object.position)) return false;
    }
    return true;
  }

  Layout& layout_;
  const Missions& wanted_;
  std::optional<RoomIndex> locked_room_;
};

}  // namespace

void any_mission(Layout& layout) { MissionGenerator(layout).run(); }

}  // namespace wordgaze::babyai::generators
