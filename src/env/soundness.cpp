#include "soundness.hpp"

#include <algorithm>
#include <bitset>
#include <stdexcept>
#include <string>

#include "wordgaze/babyai/generator.hpp"
#include "wordgaze/babyai/wording.hpp"

namespace wordgaze::env {
namespace {

using babyai::Rule;
using grid::kNothing;
using grid::kNowhere;
using grid::kWall;
using grid::Object;
using grid::ObjectId;
using grid::ObjectSet;
using grid::Position;
using grid::Type;

constexpr int kMostSteps = 1'000'000'000;

void expect(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(std::string("restore: the state is damaged: ") + what);
}

class Checker {
 public:
  Checker(const babyai::LevelSpec& level, const grid::World& world, const babyai::Task& task)
      : level_(level), world_(world), task_(task) {}

  void run() const {
    // In this order: what comes later follows what was checked before.
    check_objects();
    check_grid();
    check_agent();
    check_boxes();
    check_instruction();
    check_sentence();
    check_target();
  }

 private:
  bool exists(ObjectId id) const { return id < world_.objects.size(); }
  bool is_thing(ObjectId id) const { return id > kWall && exists(id); }
  bool in_grid(Position p) const { return world_.grid.contains(p); }
  bool in_play(ObjectId id) const { return world_.stands(id) || world_.carried == id; }

  void check_objects() const {
    const auto is = [](const Object& o, Type type, grid::Color color) {
      return o.type == type && o.color == color && o.state == grid::DoorState::open &&
             o.contents == kNothing && o.position == kNowhere;
    };
    const auto& objects = world_.objects;
    expect(objects.size() > kWall && objects.size() <= grid::kMaxObjects, "number of objects");
    expect(is(objects[kNothing], Type::empty, grid::Color::red) &&
               is(objects[kWall], Type::wall, grid::Color::grey),
           "its first two objects are not nothing and the wall");
    for (std::size_t k = kWall + 1; k < objects.size(); ++k) {
      const Object& o = objects[k];
      expect(o.type != Type::unseen && o.type != Type::empty && o.type != Type::agent,
             "type of an object");
      expect(o.type == Type::door || o.state == grid::DoorState::open, "door that is none");
      expect(o.contents == kNothing || (o.type == Type::box && is_thing(o.contents)),
             "contents of a box");
      expect(o.position == kNowhere || in_grid(o.position), "position of an object");
    }
  }

  void check_grid() const {
    const auto& grid = world_.grid;
    expect(grid.is_framed(), "size or frame of the grid");
    for (int y = 0; y < grid.height(); ++y) {
      for (int x = 0; x < grid.width(); ++x) {
        const ObjectId id = grid[grid::at(x, y)];
        expect(exists(id), "object in a cell");
        const Object& o = world_.object(id);
        // Floor, lava and goals may be one object in many cells.
        const bool single = grid::can_be_carried(o) || o.type == Type::door;
        expect(!single || o.position == grid::at(x, y), "object that stands elsewhere");
      }
    }
  }

  void check_agent() const {
    const auto& w = world_;
    expect(in_grid(w.agent) && grid::can_be_entered(w.object_at(w.agent)), "place of the agent");
    expect(w.carried == kNothing || (is_thing(w.carried) && !w.stands(w.carried) &&
                                     grid::can_be_carried(w.object(w.carried))),
           "what the agent carries");
    expect(w.carried == kNothing ? w.carried_from == kNowhere || in_grid(w.carried_from)
                                 : in_grid(w.carried_from),
           "where the agent took what it carries");
    expect(w.step_count >= 0 && w.step_count <= kMostSteps, "number of steps");
    expect(w.room_size == 0 || (w.room_size > 1 && w.room_size <= babyai::kMaxGridSide),
           "size of a room");
    expect(w.see_through_walls == level_.see_through_walls, "sight through walls");
  }

  /// What lies in a box is nowhere else, nor in another box.
  void check_boxes() const {
    std::bitset<grid::kMaxObjects> boxed;
    for (std::size_t k = kWall + 1; k < world_.objects.size(); ++k) {
      if (!in_play(static_cast<ObjectId>(k))) continue;
      for (ObjectId in = world_.objects[k].contents; in != kNothing;
           in = world_.object(in).contents) {
        expect(!in_play(in) && !boxed[in], "contents of a box");
        boxed.set(in);
      }
    }
  }

  void check_meant(ObjectSet meant, const babyai::Description& d) const {
    expect(!d.type || babyai::word_of(*d.type) != babyai::kPadding, "type in a description");
    for (ObjectId id = 0; id < grid::kMaxObjects; ++id) {
      if ((meant & grid::only(id)) == 0) continue;
      expect(id != kNothing && exists(id) &&
                 world_.object(id).type == d.type.value_or(world_.object(id).type) &&
                 world_.object(id).color == d.color.value_or(world_.object(id).color),
             "object that is meant");
    }
  }

  void check_instruction() const {
    const babyai::Instruction& i = task_.instruction;
    expect(is_grammatical(i), "instruction");
    expect(level_.rule != Rule::instruction || i.clauses() > 0, "no instruction");
    for (std::size_t k = 0; k < i.clause.size(); ++k) {
      if (static_cast<int>(k) >= i.clauses()) {
        expect(i.clause[k] == babyai::Clause{} && i.order[k] == babyai::Order::any,
               "clause behind the last");
      }
      check_meant(task_.meaning.object[k], i.clause[k].object);
      check_meant(task_.meaning.next_to[k], i.clause[k].next_to);
    }
    expect(in_grid(task_.meaning.agent), "where the agent stood");
    expect(task_.max_steps > 0 && task_.max_steps == babyai::step_limit(level_, i), "step limit");
  }

  void check_sentence() const {
    const babyai::Sentence& s = task_.sentence;
    if (level_.rule == Rule::instruction) {
      expect(s == babyai::wording(task_.instruction, task_.meaning), "words of the mission");
      return;
    }
    expect(s.length >= 0 && s.length <= babyai::kMaxMissionWords, "length of the mission");
    for (int k = 0; k < babyai::kMaxMissionWords; ++k) {
      const auto n = static_cast<std::size_t>(k);
      expect(s.words[n] < babyai::kVocabularySize &&
                 (s.words[n] == babyai::kPadding) == (k >= s.length),
             "word of the mission");
      expect(s.sub_task_of[n] >= -1 && s.sub_task_of[n] < 2 * babyai::Instruction::kMaxClauses,
             "sub-task of a word");
    }
  }

  void check_target() const {
    const babyai::Target& target = task_.target;
    expect(exists(target.object) && exists(target.other), "target");
    expect(in_grid(target.place) && in_grid(target.trap), "place of the target");
    if (const ObjectId start = task_.start_carrying; start != kNothing) {
      expect(is_thing(start), "what is carried from the start");
      // The first view puts it back to where it lay.
      expect(world_.step_count > 0 ||
                 (world_.carried == start && in_grid(world_.object(start).position)),
             "what is carried from the start");
    }
    if (level_.rule != Rule::dynamic_obstacles) return;
    expect(is_thing(target.object), "first obstacle");
    for (std::size_t k = target.object; k < world_.objects.size(); ++k) {
      expect(world_.stands(static_cast<ObjectId>(k)), "obstacle out of the grid");
    }
  }

  const babyai::LevelSpec& level_;
  const grid::World& world_;
  const babyai::Task& task_;
};

}  // namespace

void check_sound(const babyai::LevelSpec& level, const grid::World& world,
                 const babyai::Task& task) {
  Checker(level, world, task).run();
}

}  // namespace wordgaze::env
