#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "wordgaze/bot/bot.hpp"
#include "wordgaze/env/policy.hpp"
#include "wordgaze/env/random_policy.hpp"

namespace wordgaze::bot {

/// The bot as a policy for any environment: it mostly declares with `done` what has come true,
/// where that counts, and leaves the rest of an episode to the random policy when it has no more to
/// say.
class Policy {
 public:
  Policy(std::string_view id, std::uint64_t seed, std::uint64_t policy_seed = 0)
      : random_(id, seed, policy_seed) {}

  grid::Action operator()(const env::Environment& env);

 private:
  env::RandomPolicy random_;
  std::optional<Bot> bot_;
  std::optional<grid::Action> last_;  // none: the episode has just begun
};

/// Policies by name: "random", "bot" or "mixed" (the bot for even seeds). Throws
/// std::invalid_argument for another name.
env::PolicyMaker policy_maker(std::string_view name);

}  // namespace wordgaze::bot
