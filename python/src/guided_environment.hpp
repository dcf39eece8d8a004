#pragma once
#include <optional>

#include "wordgaze/bot/bot.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::python {

/// An environment with BabyAI's expert beside it, who watches from when it is first asked, at the
/// start of an episode. A value.
class GuidedEnvironment {
 public:
  explicit GuidedEnvironment(const babyai::LevelSpec& level) : env_(level) {}

  const env::Environment& env() const { return env_; }

  /// Calls of the environment that start another episode, or put it somewhere else.
  template <class Change>
  void change(Change change) {
    change(env_);
    bot_.reset();
    taken_.reset();
    advice_.reset();
    asked_ = false;
  }
  void set_rng(const core::Rng& rng) { env_.set_rng(rng); }

  env::Transition step(grid::Action action);

  /// What the expert would do now; none when it has given up. Throws std::logic_error when it is
  /// first asked in mid-episode, std::invalid_argument for a level without instructions.
  std::optional<grid::Action> advice();

 private:
  env::Environment env_;
  std::optional<bot::Bot> bot_;
  std::optional<grid::Action> taken_, advice_;
  bool asked_ = false;  // in the state that the environment is in
};

}  // namespace wordgaze::python
