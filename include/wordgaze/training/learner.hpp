#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/agent.hpp"
#include "wordgaze/nn/finite.hpp"
#include "wordgaze/optim/adam.hpp"
#include "wordgaze/optim/clip.hpp"
#include "wordgaze/training/divergence.hpp"
#include "wordgaze/training/loss.hpp"

namespace wordgaze::training {

/// The learning half of recurrent PPO: weights, optimizer and the passes over a rollout. Sequences
/// of a minibatch are shared out to the team; gradients are summed in the order of the workers, so
/// the same number of workers repeats a run bit for bit.
template <class Agent>
class Learner {
 public:
  using Scalar = typename Agent::Scalar;
  using Losses = BasicLosses<Scalar>;
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
        before_{weights_.params, adam_},
        workers_(static_cast<std::size_t>(team.size())),
        grads_(agent.make_gradients(team.size())) {}

  /// Updates in a row that may leave out minibatches.
  static constexpr int kPatience = 10;

  /// Of an update: means over the minibatches that were applied.
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

  /// All epochs over a rollout whose advantages are estimated. A minibatch whose gradient is not
  /// finite is left out.
  ///
  /// Throws std::runtime_error that names what is not finite: a number of the rollout; a loss or a
  /// gradient, when no minibatch could be applied or kPatience updates in a row have left some out;
  /// weights or moments after the update. Weights and optimizer are then what they were before.
  Report learn(const Rollout& rollout, const Rates& rates, core::Rng& rng) {
    if (const auto what = first_not_finite(rollout); !what.empty()) {
      fail_diverged(what + " is not finite");
    }
    before_.params = weights_.params;
    before_.adam = adam_;
    order_.resize(static_cast<std::size_t>(rollout.sequences()));
    std::iota(order_.begin(), order_.end(), 0);
    const auto size = order_.size() / static_cast<std::size_t>(ppo_->minibatches);
    Sums sums;
    std::string culprit;
    for (int epoch = 0; epoch < ppo_->epochs; ++epoch) {
      rng.shuffle(std::span<int>(order_));
      for (std::size_t from = 0; from + size <= order_.size(); from += size) {
        const auto sequences = std::span<const int>(order_).subspan(from, size);
        differentiate(rollout, sequences, rates);
        agent_->reduce(weights_, grads_, *team_);
        const double norm = gradient_norm();
        if (!std::isfinite(norm)) {
          if (sums.skipped++ == 0) culprit = flaw_of_minibatch();
          continue;
        }
        sums.add(norm, workers_);
        step(rates, optim::clip_scale(norm, ppo_->gradient_norm));
        agent_->refresh(weights_, *team_);
      }
    }
    in_a_row_ = sums.skipped > 0 ? in_a_row_ + 1 : 0;
    if (sums.applied == 0) fail("in every minibatch, " + culprit);
    if (in_a_row_ >= kPatience) fail(std::to_string(kPatience) + " updates in a row, " + culprit);
    if (const auto what = flaw_of(weights_.params, adam_); !what.empty()) fail(what);
    return report(sums, static_cast<double>(size) * rollout.chunk);
  }

  const Weights& weights() const { return weights_; }
  const Params& params() const { return weights_.params; }
  const Adam& adam() const { return adam_; }
  /// Throws std::runtime_error that names a tensor from which nothing can be learned: one that is
  /// not finite, or a negative variance.
  void restore(Params params, Adam adam) {
    if (const auto what = flaw_of(params, adam); !what.empty()) throw std::runtime_error(what);
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
  void add_loss(std::unique_ptr<BasicLoss<Scalar>> loss) { losses_.push_back(std::move(loss)); }
  const Losses& losses() const { return losses_; }

 private:
  /// What one worker works with: its share of a minibatch.
  struct Worker {
    BasicBatch<Scalar> batch;
    Matrix<Scalar> text;
    typename Agent::Cache cache;
    model::Outputs<Scalar> outputs, gradient;
    std::vector<double> sums;  // what the losses report of a minibatch, one behind the other
    double squared_norm = 0;   // of its part of the sum of all gradients
  };
  /// Over the minibatches of an update.
  struct Sums {
    double norm = 0;
    std::vector<double> losses;
    int applied = 0, skipped = 0;
    void add(double n, const std::vector<Worker>& workers) {
      norm += n;
      ++applied;
      losses.resize(workers.front().sums.size());
      for (const Worker& worker : workers) {
        for (std::size_t k = 0; k < losses.size(); ++k) losses[k] += worker.sums[k];
      }
    }
  };

  /// Gathers each worker's share, and forward, loss and backward over it.
  void differentiate(const Rollout& rollout, std::span<const int> sequences, const Rates& rates) {
    const AdvantageScale scale = advantage_scale(rollout, sequences, ppo_->advantage_floor);
    const auto per_frame =
        Scalar(1) / static_cast<Scalar>(sequences.size() * static_cast<std::size_t>(rollout.chunk));
    std::size_t reports = 0;
    for (const auto& loss : losses_) reports += loss->reports().size();
    team_->run([&](int w) {
      const auto [from, to] = team_->share(static_cast<int>(sequences.size()), w);
      Worker& k = workers_[static_cast<std::size_t>(w)];
      Weights& grads = grads_[static_cast<std::size_t>(w)];
      nn::set_zero(grads);
      k.sums.assign(reports, 0);
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

  void add_losses(Worker& k, const Rates& rates, Scalar scale) const {
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

  /// What of the minibatch at hand is not finite.
  std::string flaw_of_minibatch() const {
    std::size_t k = 0;
    for (const auto& loss : losses_) {
      for (const auto name : loss->reports()) {
        for (const Worker& worker : workers_) {
          if (!std::isfinite(worker.sums[k])) return std::string(name) + " is not finite";
        }
        ++k;
      }
    }
    const auto leaf = nn::first_not_finite(grads_.front().params);
    if (leaf.empty()) return "the norm of the gradient is not finite";
    return "the gradient of '" + leaf + "' is not finite";
  }

  /// The first tensor with which learning cannot go on; empty where all is well.
  static std::string flaw_of(const Params& params, const Adam& adam) {
    const auto said = [](const std::string& leaf, const char* what) {
      return leaf.empty() ? leaf : "'" + leaf + what;
    };
    auto flaw = said(nn::first_not_finite(params), "' is not finite");
    if (flaw.empty()) flaw = said(nn::first_not_finite(adam.mean), "', Adam's mean, is not finite");
    const auto no_variance = [](const auto& leaf) { return !(leaf.array() >= 0).all(); };
    if (flaw.empty()) {
      flaw = said(nn::first_leaf(adam.variance, no_variance),
                  "', Adam's variance, is negative or not a number");
    }
    if (flaw.empty()) {
      flaw = said(nn::first_not_finite(adam.variance), "', Adam's variance, is not finite");
    }
    return flaw;
  }

  /// Takes the update at hand back.
  [[noreturn]] void fail(const std::string& what) {
    weights_.params = before_.params;
    adam_ = before_.adam;
    agent_->refresh(weights_, *team_);
    fail_diverged(what);
  }

  Report report(const Sums& sums, double frames) const {
    Report report{.losses = {}, .gradient_norm = sums.norm / sums.applied, .skipped = sums.skipped};
    auto sum = sums.losses.begin();
    for (const auto& loss : losses_) {
      for (const auto name : loss->reports()) {
        report.losses.emplace_back(name, *sum++ / (frames * sums.applied));
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
  struct {
    Params params;
    Adam adam;
  } before_;          // the update at hand
  int in_a_row_ = 0;  // updates that have left out minibatches
  std::vector<Worker> workers_;
  std::vector<Weights> grads_;  // of each worker
  std::vector<int> order_;
};

}  // namespace wordgaze::training
