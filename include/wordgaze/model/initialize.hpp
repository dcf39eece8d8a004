#pragma once
#include <cmath>
#include <numbers>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/model/agent.hpp"

/// The weights before training. docs/reading.md says which of this is a prior.
namespace wordgaze::model {

/// Entries uniform in [-limit, limit].
template <class M>
void fill_uniform(M&& leaf, double limit, core::Rng& rng) {
  for (Index i = 0; i < leaf.size(); ++i) {
    leaf.data()[i] = static_cast<typename std::decay_t<M>::Scalar>(limit * (2 * rng.uniform() - 1));
  }
}

/// Uniform entries of variance gain^2 / fan-in: keeps the size of a signal.
template <class M>
void fill_scaled(M& leaf, double gain, core::Rng& rng) {
  fill_uniform(leaf, gain * std::sqrt(3.0 / static_cast<double>(leaf.cols())), rng);
}

/// Standard normal entries (Box-Muller).
template <class M>
void fill_normal(M& leaf, core::Rng& rng) {
  for (Index i = 0; i < leaf.size(); ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - rng.uniform()));
    leaf.data()[i] =
        static_cast<typename M::Scalar>(radius * std::cos(2 * std::numbers::pi * rng.uniform()));
  }
}

/// The 3x3 encoder starts near the 1x1 one: a cell says more than its neighbors, and the second
/// convolution begins as the identity with small random weights around it.
template <std::floating_point S>
void initialize_patches(const Config& config, typename PatchEncoder<S>::Params& p, core::Rng& rng) {
  fill_uniform(p.first.weight, 0.1, rng);
  auto center = p.first.weight.middleCols(kTaps / 2 * kCellFeatures, kCellFeatures);
  fill_uniform(center, 0.5, rng);
  p.first.bias.setConstant(static_cast<S>(config.encoder_bias));
  fill_scaled(p.second.weight, 0.3, rng);
  p.second.weight.middleCols(kTaps / 2 * config.channels, config.channels).diagonal().array() +=
      S(1);
}

/// Every word starts with a score of `config.object_prior` on objects over all other cells: channel
/// 0 of the encoding is 1 on key, ball and box and 0 elsewhere, and entry 0 of queries and keys
/// carries the product. All of it stays learnable.
template <std::floating_point S>
void set_object_prior(const Config& config, typename Agent<S>::Params& p) {
  constexpr Index kFirstObject = 5, kObjects = 3;  // key, ball, box
  if (config.encoder == Encoder::patch) {
    auto& [first, second] = p.patches;
    first.weight.row(0).setZero();
    first.weight.row(0).segment(kTaps / 2 * kCellFeatures + kFirstObject, kObjects).setOnes();
    first.bias(0) = 0;
    second.weight.row(0).setZero();
    second.weight(0, kTaps / 2 * config.channels) = 1;
  } else {
    p.visual.weight.row(0).setZero();
    p.visual.weight.row(0).segment(kFirstObject, kObjects).setOnes();
    p.visual.bias(0) = 0;
  }
  p.words.row(0).setOnes();
  const auto entry = static_cast<S>(
      std::sqrt(config.object_prior * std::sqrt(static_cast<double>(config.key_size))));
  p.attention.query.row(0).setZero();
  p.attention.key.row(0).setZero();
  p.attention.query(0, 0) = entry;
  p.attention.key(0, 0) = entry;
}

template <std::floating_point S>
typename Agent<S>::Params initialize(const Agent<S>& agent, core::Rng& rng) {
  const Config& config = agent.config;
  auto p = agent.make_params();
  if (agent.sees_patches()) {
    initialize_patches<S>(config, p.patches, rng);
  } else {
    fill_uniform(p.visual.weight, 0.5, rng);
    p.visual.bias.setConstant(static_cast<S>(config.encoder_bias));
  }
  fill_normal(p.words, rng);
  if (config.attention) {
    fill_scaled(p.attention.query, 1, rng);
    fill_scaled(p.attention.key, 1, rng);
    if (config.object_prior > 0) set_object_prior<S>(config, p);
  }
  fill_scaled(p.memory.input_weight, 1, rng);
  fill_scaled(p.memory.hidden_weight, 1, rng);
  p.memory.bias.segment(config.memory_size, config.memory_size).setOnes();  // the forget gate
  const double gru_limit = 1 / std::sqrt(static_cast<double>(config.text_size));
  fill_uniform(p.text.input_weight, gru_limit, rng);
  fill_uniform(p.text.hidden_weight, gru_limit, rng);
  fill_uniform(p.text.bias, gru_limit, rng);
  fill_uniform(p.text.candidate_bias, gru_limit, rng);
  if (config.task_attention) {
    fill_scaled(p.task.hidden.weight, std::numbers::sqrt2, rng);
    fill_scaled(p.task.output.weight, 0.1, rng);
    p.task.output.bias.setConstant(2);  // every word bright at the start
  }
  for (auto* head : {&p.actor, &p.critic}) {
    fill_scaled(head->hidden.weight, std::numbers::sqrt2, rng);
    fill_scaled(head->output.weight, head == &p.actor ? 0.01 : 1.0, rng);
  }
  return p;
}

}  // namespace wordgaze::model
