#pragma once
#include <stdexcept>
#include <string>

namespace wordgaze::training {

/// Ends training where a number is no longer finite: `what` says which, as "the gradient of
/// 'memory.bias' is not finite". Nothing of the update at hand may be kept.
[[noreturn]] inline void fail_diverged(const std::string& what) {
  throw std::runtime_error(
      "training has diverged: " + what +
      "; nothing of this update is kept, and the last checkpoint is as it was. Start another run "
      "from its weights (train --init CHECKPOINT --out ANOTHER) with a lower ppo.learning_rate");
}

}  // namespace wordgaze::training
