#pragma once
#include <cstddef>
#include <span>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::policy {

/// One decision.
struct Decision {
  std::size_t action = 0;
  float log_prob = 0;  ///< of the action
  float entropy = 0;   ///< of the policy, nats
  float value = 0;     ///< what the critic expects

  grid::Action as_action() const { return static_cast<grid::Action>(action); }
};

// Samplers choose an action from the log-probabilities of a lane.

/// The likeliest action.
struct Greedy {
  std::size_t operator()(int /*lane*/, std::span<const float> log_probs) const {
    return nn::Categorical<float>::greedy(log_probs);
  }
};

/// Drawn from the policy.
struct Sampled {
  core::Rng& rng;
  std::size_t operator()(int /*lane*/, std::span<const float> log_probs) const {
    return nn::Categorical<float>::sample(log_probs, static_cast<float>(rng.uniform()));
  }
};

}  // namespace wordgaze::policy
