#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/agent.hpp"
#include "wordgaze/optim/adam.hpp"
#include "wordgaze/optim/clip.hpp"
#include "wordgaze/training/loss.hpp"

namespace wordgaze::training {

/// The learning half of recurrent PPO: weights, optimizer and the passes over a rollout. Sequences
/// of a minibatch are shared out to the team; gradients are summed in the order of the workers, so
/// the same number of workers repeats a run bit for bit.
template <class Agent>
class Learner {
 public:
  using Params = typename Agent::Params;
  using Weights = typename Agent::Weights;
  using Adam = optim::Adam<Params>;

  Learner(const Agent& agent, const PpoConfig& ppo, Losses losses, Params params, Team& team)
      : agent_(&agent),
        ppo_(&ppo),
        losses_(std::move(losses)),
        team_(&team),
        weights_(agent.make_weights(std::move(params))),
        adam_(weights_.params),
        workers_(static_cast<std::size_t>(team.size())),
        grads_(agent.make_gradients(team.size())) {}

  /// Of an update: means over all minibatches.
  struct Report {
    std::vector<std::pair<std::string_view, double>> losses;  ///< what the terms report
    double gradient_norm = 0;                                 ///< before clipping
    int skipped = 0;  ///< minibatches whose gradient was not finite: not applied

    /// NaN for what no term reports.
    double of(std::string_view name) const {
      for (const auto& [key, value] : losses) {
        if (key == name) return value;
      }
      return std::numeric_limits<double>::quiet_NaN();
    }
  };

  /// All epochs over a rollout whose advantages are estimated. Throws std::runtime_error when no
  /// minibatch gave a finite gradient.
  Report learn(const Rollout& rollout, const Rates& rates, core::Rng& rng) {
    order_.resize(static_cast<std::size_t>(rollout.sequences()));
    std::iota(order_.begin(), order_.end(), 0);
    const auto size = order_.size() / static_cast<std::size_t>(ppo_->minibatches);
    Sums sums;
    for (int epoch = 0; epoch < ppo_->epochs; ++epoch) {
      rng.shuffle(std::span<int>(order_));
      for (std::size_t from = 0; from + size <= order_.size(); from += size) {
        const auto sequences = std::span<const int>(order_).subspan(from, size);
        differentiate(rollout, sequences, rates);
        agent_->reduce(weights_, grads_, *team_);
        const double norm = gradient_norm();
        sums.add(norm);
        if (!std::isfinite(norm)) continue;
        step(rates, optim::clip_scale(norm, ppo_->gradient_norm));
        agent_->refresh(weights_, *team_);
      }
    }
    return report(sums, static_cast<double>(rollout.shape.columns()) * ppo_->epochs);
  }

  const Weights& weights() const { return weights_; }
  const Params& params() const { return weights_.params; }
  const Adam& adam() const { return adam_; }
  void restore(Params params, Adam adam) {
    weights_.params = std::move(params);
    adam_ = std::move(adam);
    agent_->refresh(weights_, *team_);
  }
  /// How far the gaze has focused, if the agent has one that does.
  void set_focus(double focus) {
    if constexpr (requires { agent_->set_focus(weights_.params, focus); }) {
      if (agent_->set_focus(weights_.params, focus)) agent_->refresh(weights_, *team_);
    }
  }
  /// Another term of the loss, beside those that it has.
  void add_loss(std::unique_ptr<Loss> loss) { losses_.push_back(std::move(loss)); }
  const Losses& losses() const { return losses_; }

 private:
  /// What one worker works with: its share of a minibatch.
  struct Worker {
    Batch batch;
    Matrix<float> text;
    typename Agent::Cache cache;
    model::Outputs<float> outputs, gradient;
    std::vector<double> sums;  // what the losses report, one behind the other
    double squared_norm = 0;   // of its part of the sum of all gradients
  };
  struct Sums {
    double norm = 0;
    int applied = 0, skipped = 0;
    void add(double n) {
      if (std::isfinite(n)) {
        norm += n;
        ++applied;
      } else {
        ++skipped;
      }
    }
  };

  /// Gathers each worker's share, and forward, loss and backward over it.
  void differentiate(const Rollout& rollout, std::span<const int> sequences, const Rates& rates) {
    const AdvantageScale scale = advantage_scale(rollout, sequences, ppo_->advantage_floor);
    const float per_frame =
        1.0f / static_cast<float>(sequences.size() * static_cast<std::size_t>(rollout.chunk));
    team_->run([&](int w) {
      const auto [from, to] = team_->share(static_cast<int>(sequences.size()), w);
      Worker& k = workers_[static_cast<std::size_t>(w)];
      Weights& grads = grads_[static_cast<std::size_t>(w)];
      nn::set_zero(grads);
      if (from == to) return;
      const auto own =
          sequences.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from));
      k.batch.gather(agent_->config, rollout, own, scale);
      const auto& x = k.batch.frames;
      const auto& missions = k.batch.missions;
      if (k.text.cols() < missions.size())
        k.text.resize(model::mission_features(agent_->config), missions.size());
      agent_->encode_text(weights_, missions, k.cache, k.text);
      agent_->forward(weights_, x, missions, k.text, k.cache, k.outputs);
      if (k.gradient.logits.cols() != x.shape.columns()) {
        k.gradient.resize(agent_->config, x.shape.columns());
      }
      k.gradient.set_zero();
      add_losses(k, rates, per_frame);
      agent_->backward(weights_, x, missions, k.outputs, k.gradient, k.cache, grads);
    });
  }

  void add_losses(Worker& k, const Rates& rates, float scale) const {
    std::size_t size = 0;
    for (const auto& loss : losses_) size += loss->reports().size();
    k.sums.resize(size);
    std::span<double> sums(k.sums);
    for (const auto& loss : losses_) {
      const std::size_t own = loss->reports().size();
      loss->add(k.batch, k.outputs, rates, scale, k.gradient, sums.first(own));
      sums = sums.subspan(own);
    }
  }

  double gradient_norm() {
    team_->run([&](int w) {
      workers_[static_cast<std::size_t>(w)].squared_norm =
          nn::squared_norm(grads_.front().params, {w, team_->size()});
    });
    double total = 0;
    for (const Worker& worker : workers_) total += worker.squared_norm;
    return std::sqrt(total);
  }

  void step(const Rates& rates, double scale) {
    const auto rate = [&](const nn::Path& path) {
      return path.group == model::kTaskGroup ? rates.task_learning_rate : rates.learning_rate;
    };
    adam_.begin_step();
    team_->run([&](int w) {
      adam_.update(weights_.params, grads_.front().params, rate, scale, {w, team_->size()});
    });
  }

  Report report(const Sums& sums, double frames) {
    if (sums.applied == 0) {
      throw std::runtime_error(
          "training has diverged: no minibatch of this update gave a finite gradient; go on from "
          "an earlier checkpoint with a lower ppo.learning_rate");
    }
    Report report{.losses = {}, .gradient_norm = sums.norm / sums.applied, .skipped = sums.skipped};
    std::size_t k = 0;
    for (const auto& loss : losses_) {
      for (const auto name : loss->reports()) {
        double total = 0;
        for (Worker& worker : workers_) {
          if (k < worker.sums.size()) total += std::exchange(worker.sums[k], 0);
        }
        report.losses.emplace_back(name, total / frames);
        ++k;
      }
    }
    return report;
  }

  const Agent* agent_;
  const PpoConfig* ppo_;
  Losses losses_;
  Team* team_;
  Weights weights_;
  Adam adam_;
  std::vector<Worker> workers_;
  std::vector<Weights> grads_;  // of each worker
  std::vector<int> order_;
};

}  // namespace wordgaze::training
