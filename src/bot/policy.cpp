#include "wordgaze/bot/policy.hpp"

#include <algorithm>

#include "wordgaze/core/require.hpp"

namespace wordgaze::bot {

using env::Environment;
using grid::Action;

namespace {

bool something_to_declare(const Environment& env) {
  const auto matched = env.matched();
  return env.spec().done_mode != babyai::DoneMode::off &&
         std::find(matched.begin(), matched.end(), 1) != matched.end();
}

}  // namespace

Action Policy::operator()(const Environment& env) {
  if (env.step_count() == 0) {
    bot_.reset();
    last_.reset();
    if (env.instruction().clauses() > 0) bot_.emplace(env);
  }
  if (!bot_) return random_(env);
  if (something_to_declare(env) && random_.percent() < 85) {
    bot_->next(env, last_);  // it has to hear of every action: of the pickup that is declared now
    last_ = Action::done;
    return Action::done;
  }
  last_ = bot_->next(env, last_);
  if (last_ && *last_ != Action::done) return *last_;
  bot_.reset();
  return random_(env);
}

env::PolicyMaker policy_maker(std::string_view name) {
  const env::PolicyMaker bot = env::make_policy<Policy>;
  const env::PolicyMaker random = env::make_policy<env::RandomPolicy>;
  if (name == "bot") return bot;
  if (name == "random") return random;
  require(name == "mixed", "policy '{}': expected random, bot or mixed", name);
  return [=](std::string_view id, std::uint64_t seed, std::uint64_t policy_seed) {
    return (seed % 2 == 0 ? bot : random)(id, seed, policy_seed);
  };
}

}  // namespace wordgaze::bot
