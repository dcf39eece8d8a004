#pragma once
#include <initializer_list>
#include <optional>

#include "wordgaze/bot/memory.hpp"
#include "wordgaze/grid/world.hpp"

namespace wordgaze::bot {

/// Thrown where the reference's bot raises an error, or plans for ever.
struct GivesUp {};

/// The rules by which the plan changes and becomes an action, for one moment of the world.
class Planner {
 public:
  Planner(const grid::World& world, Memory& memory) : world_(world), memory_(memory) {}

  /// The next action after `taken` (none: it is the first one), with a look around.
  grid::Action next_action(std::optional<grid::Action> taken);

 private:
  using Action = grid::Action;
  using Position = grid::Position;

  // What an action means for the subgoal that was next when it was taken.
  void after(Close, Action taken);
  void after(Open, Action taken);
  void after(Drop, Action taken);
  void after(PickUp, Action taken);
  void after(const GoTo&, Action taken);
  void after(Explore, Action) {}
  void undo(Action taken);

  // The action for the subgoal that is next; none when the plan has changed instead.
  std::optional<Action> act(Close);
  std::optional<Action> act(Open);
  std::optional<Action> act(Drop);
  std::optional<Action> act(PickUp);
  std::optional<Action> act(const GoTo&);
  std::optional<Action> act(Explore);

  // Parts of going somewhere.
  struct Found {
    grid::ObjectId object;  // kNothing for a mere place
    Position place;
  };
  std::optional<Found> find(const Target& target, bool beside) const;
  std::optional<Found> closest(const Sought& sought, bool beside) const;
  Action step_aside() const;
  Action turn_towards(Position neighbor) const;
  std::optional<Action> walk_on();
  void clear_the_way();

  // The plan.
  const Subgoal& next();
  void do_first(std::initializer_list<Subgoal> subgoals);  // in this order
  void finish() { memory_.plan.pop_back(); }
  bool is_exploring();

  // The world.
  const grid::Object& ahead() const { return world_.object_at(world_.front()); }
  Position right() const { return forward(turned(world_.direction, 1)); }
  bool carries_something() const { return world_.carried != grid::kNothing; }
  bool carries_key_of(const grid::Object& door) const;
  Key keys_of(const grid::Object& door);
  Place drop_place(Place reserved = {}) const;

  const grid::World& world_;
  Memory& memory_;
  int looks_ = 0;
};

}  // namespace wordgaze::bot
