#pragma once
#include "wordgaze/rl/actor.hpp"

namespace wordgaze::rl {

/// A decision that has been taken and not yet carried out. The actor's cache still holds all that
/// led to it, the memory before it too.
struct Decision {
  const Actor& actor;
  int lane;
  const env::Environment& environment;
  std::size_t action;
};

/// Looks into each decision of an evaluation. Called from one thread, in order; an observer
/// (rl/observer.hpp) is told what happened, a witness sees the network at work.
class Witness {
 public:
  virtual ~Witness() = default;
  virtual void on_decision(const Decision& decision) = 0;
};

}  // namespace wordgaze::rl
