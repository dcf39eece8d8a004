#include "wordgaze/rl/learner.hpp"

#include <numeric>

#include "wordgaze/optim/clip.hpp"
#include "wordgaze/rl/attention_loss.hpp"

namespace wordgaze::rl {

Learner::Learner(const Agent& agent, const PpoConfig& ppo, Agent::Params params, Team& team)
    : agent_(&agent),
      ppo_(&ppo),
      team_(&team),
      params_(std::move(params)),
      adam_(params_),
      tables_(agent.make_tables()),
      workers_(static_cast<std::size_t>(team.size())) {
  for (Worker& worker : workers_) {
    worker.grads = nn::zeros_like(params_);
    worker.dtables = agent.make_tables();
    // With 1x1 the input weight's gradient comes from the tables alone and lies with the first.
    if (&worker != &workers_.front() && !agent.sees_patches()) {
      worker.grads.memory.input_weight.resize(0, 0);
    }
  }
  update_tables();
}

void Learner::restore(Agent::Params params, optim::Adam<Agent::Params> adam) {
  params_ = std::move(params);
  adam_ = std::move(adam);
  update_tables();
}

void Learner::update_tables() {
  agent_->update_tables(params_, tables_);
  if (agent_->sees_patches()) return;
  team_->run([&](int w) {
    const auto [from, to] = team_->share(grid::kViewCells, w);
    agent_->update_input_table(params_, from, to, tables_);
  });
}

Learner::Report Learner::learn(const Rollout& rollout,
                               const std::vector<const model::Missions*>& missions_of_lane,
                               const Rates& rates, core::Rng& rng) {
  order_.resize(static_cast<std::size_t>(rollout.sequences()));
  std::iota(order_.begin(), order_.end(), 0);
  const auto size = order_.size() / static_cast<std::size_t>(ppo_->minibatches);
  const auto rate = [&](const nn::Path& path) {
    return path.names[0] == "task" ? rates.task : rates.base;
  };
  Report report;
  int applied = 0;
  for (int epoch = 0; epoch < ppo_->epochs; ++epoch) {
    rng.shuffle(std::span<int>(order_));
    for (int part = 0; part < ppo_->minibatches; ++part) {
      const std::span<const int> sequences =
          std::span(order_).subspan(static_cast<std::size_t>(part) * size, size);
      double sum = 0, squares = 0;
      for (const int s : sequences) {
        for (Index t = 0; t < rollout.chunk; ++t) {
          const double a = rollout.advantage[static_cast<std::size_t>(rollout.column(s, t))];
          sum += a;
          squares += a * a;
        }
      }
      const double frames = static_cast<double>(size) * rollout.chunk;
      const double mean = sum / frames;
      const double deviation = std::sqrt(std::max(0.0, squares / frames - mean * mean));
      // Without a floor, rare successes of a random policy are blown up to noise of size one.
      const double divisor = std::max({deviation, ppo_->advantage_floor, 1e-8});
      const Minibatch batch{
          .rollout = &rollout,
          .missions_of_lane = &missions_of_lane,
          .sequences = sequences,
          .advantage_mean = static_cast<float>(mean),
          .advantage_scale = static_cast<float>(1 / divisor),
          .loss = {.clip = static_cast<float>(ppo_->clip),
                   .value_coefficient = static_cast<float>(ppo_->value_coefficient),
                   .entropy_coefficient = static_cast<float>(rates.entropy)}};
      team_->run([&](int w) {
        const auto [from, to] = team_->share(static_cast<int>(size), w);
        differentiate(
            batch,
            sequences.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)),
            workers_[static_cast<std::size_t>(w)]);
      });
      sum_gradients();
      for (const Worker& worker : workers_) {
        report.loss += worker.loss;
        report.mask_loss += worker.mask_loss;
      }
      const double norm = gradient_norm();
      if (!std::isfinite(norm)) {
        ++report.skipped;
        continue;
      }
      ++applied;
      report.gradient_norm += norm;
      adam_.begin_step();
      const double scale = optim::clip_scale(norm, ppo_->gradient_norm);
      team_->run([&](int w) {
        adam_.update(params_, workers_.front().grads, rate, scale, {w, team_->size()});
      });
      update_tables();
    }
  }
  if (applied == 0) {
    throw std::runtime_error(
        "training has diverged: no minibatch of this update gave a finite gradient; go on from an "
        "earlier checkpoint with a lower ppo.learning_rate");
  }
  const double frames = static_cast<double>(rollout.shape.columns()) * ppo_->epochs;
  for (double* mean : {&report.loss.policy, &report.loss.value, &report.loss.entropy,
                       &report.loss.divergence, &report.loss.clipped, &report.mask_loss}) {
    *mean /= frames;
  }
  report.gradient_norm /= applied;
  return report;
}

/// Copies the columns of some training sequences into the worker's frames.
void Learner::gather(const Minibatch& batch, std::span<const int> sequences, Worker& worker) const {
  const Rollout& r = *batch.rollout;
  const nn::SequenceShape shape{r.chunk, static_cast<Index>(sequences.size())};
  model::Frames<float>& x = worker.frames;
  if (x.shape != shape) {
    x.resize(agent_->config, shape);
    worker.dlogits.resize(grid::kActions, shape.columns());
    worker.dvalues.resize(1, shape.columns());
  }
  worker.missions.clear();
  for (Index b = 0; b < shape.batch; ++b) {
    const int sequence = sequences[static_cast<std::size_t>(b)];
    const auto& missions = *(*batch.missions_of_lane)[static_cast<std::size_t>(r.lane(sequence))];
    x.start.h.col(b) = r.start_h.col(sequence);
    x.start.c.col(b) = r.start_c.col(sequence);
    int known = -1, local = 0;  // a mission lasts for an episode: look it up when it changes
    for (Index t = 0; t < shape.steps; ++t) {
      const Index to = shape.column(t, b), from = r.column(sequence, t);
      const int mission = r.mission_of[static_cast<std::size_t>(from)];
      if (mission != known) {
        known = mission;
        local = worker.missions.index_of(missions[mission]);
      }
      x.mission_of[static_cast<std::size_t>(to)] = local;
      x.cells.col(to) = r.cells.col(from);
      x.keep(0, to) = r.keep(0, from);
      x.completion.col(to) = r.completion.col(from);
    }
  }
}

/// Losses and gradients of a worker's share of a minibatch.
void Learner::differentiate(const Minibatch& batch, std::span<const int> sequences,
                            Worker& worker) const {
  const Rollout& r = *batch.rollout;
  nn::set_zero(worker.grads);
  Agent::set_zero(worker.dtables);
  worker.loss = {};
  worker.mask_loss = 0;
  if (sequences.empty()) return;
  gather(batch, sequences, worker);
  const auto& x = worker.frames;
  auto& cache = worker.cache;
  agent_->encode_missions(params_, tables_, worker.missions, cache);
  agent_->forward(params_, tables_, x, worker.missions, Agent::text(cache), cache);
  const float scale =
      1.0f / static_cast<float>(batch.sequences.size() * static_cast<std::size_t>(r.chunk));
  for (Index b = 0; b < x.shape.batch; ++b) {
    for (Index t = 0; t < x.shape.steps; ++t) {
      const Index n = x.shape.column(t, b);
      const Index column = r.column(sequences[static_cast<std::size_t>(b)], t);
      const auto from = static_cast<std::size_t>(column);
      batch.loss.add(
          {.action = r.action[from],
           .old_log_prob = r.log_prob[from],
           .advantage = (r.advantage[from] - batch.advantage_mean) * batch.advantage_scale,
           .value_target = r.advantage[from] + r.value[from]},
          {cache.logits().col(n).data(), grid::kActions}, cache.values()(0, n), scale,
          {worker.dlogits.col(n).data(), grid::kActions}, worker.dvalues(0, n), worker.loss);
      if (agent_->config.task_attention) {
        worker.mask_loss += attention_loss(
            worker.missions[x.mission_of[static_cast<std::size_t>(n)]], r.bright[from],
            cache.task.alpha.col(n), scale * ppo_->mask_coefficient, cache.task.dlogits.col(n));
      }
    }
  }
  agent_->backward(params_, tables_, x, worker.missions, worker.dlogits, worker.dvalues, cache,
                   worker.grads, worker.dtables);
}

/// The sum over workers, in their order, with the tables' gradients turned into those of weights.
void Learner::sum_gradients() {
  Worker& first = workers_.front();
  if (!agent_->sees_patches()) sum_input_tables();
  for (std::size_t other = 1; other < workers_.size(); ++other) {
    Worker& worker = workers_[other];
    nn::for_each_parameter(
        [](const nn::Path&, auto& sum, const auto& part) {
          if (part.size() > 0) sum += part;
        },
        first.grads, worker.grads);
    Agent::for_each_small_table([](auto& sum, const auto& part) { sum += part; }, first.dtables,
                                worker.dtables);
  }
  agent_->tables_backward(params_, tables_, first.dtables, first.grads);
}

double Learner::gradient_norm() {
  team_->run([&](int w) {
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    worker.squared_norm = nn::squared_norm(workers_.front().grads, {w, team_->size()});
  });
  double total = 0;
  for (const Worker& worker : workers_) total += worker.squared_norm;
  return std::sqrt(total);
}

/// The input tables are large, so workers share their cells out.
void Learner::sum_input_tables() {
  Worker& first = workers_.front();
  const Index codes = agent_->alphabet.size();
  team_->run([&](int w) {
    const auto [from, to] = team_->share(grid::kViewCells, w);
    auto total = first.dtables.input.middleCols(from * codes, (to - from) * codes);
    for (std::size_t other = 1; other < workers_.size(); ++other) {
      total += workers_[other].dtables.input.middleCols(from * codes, (to - from) * codes);
    }
    // Each worker has a gradient of the encodings of its own, still zero, to write to.
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    agent_->input_table_backward(params_, tables_, first.dtables, from, to, first.grads,
                                 worker.dtables.visual);
  });
}

}  // namespace wordgaze::rl
