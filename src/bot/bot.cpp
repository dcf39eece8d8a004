#include "wordgaze/bot/bot.hpp"

#include "planner.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::bot {

using babyai::Clause;
using babyai::Instruction;
using babyai::Verb;
using env::Environment;
using grid::Action;

namespace {

// Where the objects of each phrase stand: phrases 2k and 2k + 1 belong to clause k.
std::vector<Standing> look_up(const Environment& env, int phrase) {
  const int k = phrase / 2;
  const bool is_next_to = phrase % 2 != 0;
  const Clause& clause = env.instruction().clause[k];
  const babyai::Meaning& meaning = env.meaning();
  return standing(env.world(), env.verifier(), meaning,
                  is_next_to ? meaning.next_to[k] : meaning.object[k],
                  is_next_to ? clause.next_to : clause.object);
}

// The last step of a plan comes first.
void plan_clause(Verb verb, int k, std::vector<Subgoal>& plan) {
  using Purpose = GoTo::Purpose;
  const Meant object{2 * k}, next_to{2 * k + 1};
  switch (verb) {
    case Verb::go_to:
      plan.insert(plan.end(), {GoTo{object}});
      break;
    case Verb::open:
      plan.insert(plan.end(), {Open{}, GoTo{object, Purpose::open}});
      break;
    case Verb::pickup:
      // The next clause may need free hands.
      plan.insert(plan.end(), {Drop{}, PickUp{}, GoTo{object}});
      break;
    case Verb::put_next:
      plan.insert(plan.end(), {Drop{}, GoTo{next_to, Purpose::put_next}, PickUp{}, GoTo{object}});
      break;
  }
}

}  // namespace

Bot::Bot(const Environment& env)
    : memory_{.seen = {env.world().grid.width(), env.world().grid.height()}} {
  const Instruction& instruction = env.instruction();
  require(instruction.clauses() > 0, "Bot: '{}' has no instruction that it could carry out",
          env.id());
  for (int phrase = 0; phrase < 2 * instruction.clauses(); ++phrase) {
    memory_.phrases.emplace_back(look_up(env, phrase));
  }
  std::vector<int> turns;
  for (auto part = instruction.first(); part.size() > 0; part = instruction.next(part)) {
    for (int k = part.begin; k < part.end; ++k) turns.push_back(k);
  }
  for (auto k = turns.rbegin(); k != turns.rend(); ++k) {
    plan_clause(instruction.clause[*k].verb, *k, memory_.plan);
  }
}

std::optional<Action> Bot::next(const Environment& env, std::optional<Action> taken) {
  if (gave_up_) return std::nullopt;
  for (int phrase = 0; phrase < static_cast<int>(memory_.phrases.size()); ++phrase) {
    memory_.phrases[phrase].update_places(look_up(env, phrase));
  }
  try {
    return Planner(env.world(), memory_).next_action(taken ? taken : memory_.before.suggested);
  } catch (const GivesUp&) {
    gave_up_ = true;
    return std::nullopt;
  }
}

}  // namespace wordgaze::bot
