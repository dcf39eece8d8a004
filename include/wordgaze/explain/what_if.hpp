#pragma once
#include "wordgaze/rl/witness.hpp"

namespace wordgaze::explain {

/// Asks an agent about a decision again: what would it have done had it seen something else?
/// Mission, completion vector and memory are those of the decision.
class WhatIf {
 public:
  WhatIf(const rl::Agent& agent, const rl::Agent::Params& params);

  const rl::Agent& agent() const { return *agent_; }

  /// The policies [7, N] for N views, a column of 49 codes each.
  Matrix<float> policies(const rl::Decision& decision, const model::CellMatrix& views);

  /// How the logit of the action taken depends on each cell of the view as it reaches the memory,
  /// F_c [C]; for the baseline that is the visual encoding itself.
  struct Saliency {
    Vector<float> gradient;  ///< [49] length of d logit / d F_c
    Vector<float> product;   ///< [49] |F_c . d logit / d F_c|: gradient times input
  };
  Saliency saliency(const rl::Decision& decision);

 private:
  void forward(const rl::Decision& decision, const model::CellMatrix& views);

  const rl::Agent* agent_;
  const rl::Agent::Params* params_;
  rl::Agent::Tables tables_;
  rl::Agent::Params grads_;  // what the backward passes leave beside what is asked for
  model::Frames<float> frames_;
  rl::Agent::Cache cache_;
};

}  // namespace wordgaze::explain
