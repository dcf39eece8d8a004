#pragma once
#include <optional>

#include "wordgaze/bot/memory.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::bot {

/// The rule-based expert of BabyAI: it plans with what it has seen so far, and does what the bot of
/// the reference does, action by action (minigrid 3.2.0, utils/baby_ai_bot.py). Where that one
/// raises an error or would plan for ever, this one gives up. A value: a copy goes on identically.
class Bot {
 public:
  /// How often it looks at its plan for one action; more is taken for planning without end.
  static constexpr int kMaxLooks = 400;

  /// For the episode that has just begun. Throws std::invalid_argument for an environment without
  /// an instruction.
  explicit Bot(const env::Environment& env);

  /// The next action; `done` when nothing is left to do, none when it has given up. To be asked
  /// before each action. Who did not do as suggested says what was done instead: the bot then
  /// brings things back in order.
  std::optional<grid::Action> next(const env::Environment& env,
                                   std::optional<grid::Action> taken = std::nullopt);

 private:
  Memory memory_;
  bool gave_up_ = false;
};

}  // namespace wordgaze::bot
