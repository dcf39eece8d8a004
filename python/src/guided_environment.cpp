#include "guided_environment.hpp"

#include <stdexcept>

#include "wordgaze/core/formatted.hpp"

namespace wordgaze::python {

env::Transition GuidedEnvironment::step(grid::Action action) {
  if (bot_) advice();  // it is to be asked before each action
  const env::Transition transition = env_.step(action);
  taken_ = action;
  asked_ = false;
  return transition;
}

std::optional<grid::Action> GuidedEnvironment::advice() {
  if (asked_) return advice_;
  if (!bot_) {
    if (env_.step_count() != 0) {
      throw std::logic_error(
          formatted("bot_action: the expert of '{}' is asked for the first time in step {}; it has "
                    "to watch from the start of an episode: ask it after reset()",
                    env_.id(), env_.step_count()));
    }
    bot_.emplace(env_);
  }
  advice_ = bot_->next(env_, taken_);
  asked_ = true;
  return advice_;
}

}  // namespace wordgaze::python
