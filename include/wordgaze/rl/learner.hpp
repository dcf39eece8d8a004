#pragma once
#include "wordgaze/core/team.hpp"
#include "wordgaze/optim/adam.hpp"
#include "wordgaze/rl/actor.hpp"
#include "wordgaze/rl/config.hpp"
#include "wordgaze/rl/ppo_loss.hpp"
#include "wordgaze/rl/rollout.hpp"

namespace wordgaze::rl {

/// The learning half of recurrent PPO: weights, optimizer and the passes over a rollout. Sequences
/// of a minibatch are shared out to the team; gradients are summed in the order of the workers, so
/// the same number of workers repeats a run bit for bit.
class Learner {
 public:
  Learner(const Agent& agent, const PpoConfig& ppo, Agent::Params params, Team& team);

  /// Means over all minibatches of an update.
  struct Report {
    PpoLoss<float>::Sums loss;
    double mask_loss = 0;
    double gradient_norm = 0;
    int skipped = 0;  ///< minibatches whose gradient was not finite: not applied
  };
  struct Rates {
    double base, task, entropy;
  };

  /// All epochs over a rollout whose advantages are estimated. `missions_of(lane)` are the missions
  /// that rollout.mission_of counts in. Throws std::runtime_error when no minibatch gave a finite
  /// gradient.
  Report learn(const Rollout& rollout, const std::vector<const model::Missions*>& missions_of_lane,
               const Rates& rates, core::Rng& rng);

  const Agent::Params& params() const { return params_; }
  const Agent::Tables& tables() const { return tables_; }
  const optim::Adam<Agent::Params>& adam() const { return adam_; }
  void restore(Agent::Params params, optim::Adam<Agent::Params> adam);

 private:
  /// What one worker works with: its share of a minibatch and the gradients of it.
  struct Worker {
    model::Frames<float> frames;
    model::Missions missions;
    Agent::Cache cache;
    Matrix<float> dlogits, dvalues;
    Agent::Params grads;
    Agent::Tables dtables;
    PpoLoss<float>::Sums loss;
    double mask_loss = 0;
    double squared_norm = 0;  // of its part of the sum of all gradients
  };
  struct Minibatch {
    const Rollout* rollout;
    const std::vector<const model::Missions*>* missions_of_lane;
    std::span<const int> sequences;
    float advantage_mean, advantage_scale;
    PpoLoss<float> loss;
  };

  void update_tables();
  void gather(const Minibatch& batch, std::span<const int> sequences, Worker& worker) const;
  void differentiate(const Minibatch& batch, std::span<const int> sequences, Worker& worker) const;
  void sum_gradients();
  void sum_input_tables();
  double gradient_norm();

  const Agent* agent_;
  const PpoConfig* ppo_;
  Team* team_;
  Agent::Params params_;
  optim::Adam<Agent::Params> adam_;
  Agent::Tables tables_;
  std::vector<Worker> workers_;
  std::vector<int> order_;
};

}  // namespace wordgaze::rl
