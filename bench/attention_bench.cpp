// The network of configs/single.toml on a minibatch's share of one worker: forward and backward of
// all of it, and of its attention alone. Items are frames.
#include <benchmark/benchmark.h>

#include "wordgaze/policy/environment.hpp"

namespace {

using namespace wordgaze;
using policy::Agent;
using Vision = Agent::Vision;
using Attention = Agent::Attention;

constexpr nn::SequenceShape kShape{.steps = 20, .batch = 32};

struct Network : benchmark::Fixture {
  Agent agent{model::Config{}, model::CellAlphabet::one_room()};
  Agent::Weights weights, grads;
  Agent::Cache cache;
  model::Frames<float> frames;
  model::Missions missions;
  Matrix<float> text{agent.config.text_size, 1};
  model::Outputs<float> outputs, gradient;

  Network() {
    core::Rng rng(1);
    weights = agent.make_weights(agent.initialize(rng));
    grads = agent.make_weights();
    frames.resize(agent.config, kShape);
    env::Environment environment("Wordgaze-One-N8-K4-v0");
    std::array<std::uint8_t, grid::kImageBytes> image;
    for (Index n = 0; n < kShape.columns(); ++n) {
      environment.reset(n);
      environment.observe(image);
      agent.alphabet.encode(image, std::span<std::uint8_t, grid::kViewCells>(
                                       frames.cells.col(n).data(), grid::kViewCells));
    }
    missions.index_of(environment.sentence());
    gradient.resize(agent.config, kShape.columns());
    gradient.logits.setRandom();
    gradient.values.setRandom();
    forward();
    backward();
  }
  void forward() {
    agent.encode_text(weights, missions, cache, text);
    agent.forward(weights, frames, missions, text, cache, outputs);
  }
  void backward() { agent.backward(weights, frames, missions, outputs, gradient, cache, grads); }
  void attention_forward() {
    const auto& t = weights.tables;
    Vision::with_scores(agent, t.vision, t.attention.probes, frames.cells, cache.vision,
                        [&](const auto& counts, auto&& score_of) {
                          Attention::forward_words(agent.config, counts, score_of, frames, missions,
                                                   cache.attention);
                        });
    Attention::forward_gaze(agent.config, frames, missions, cache.alpha, cache.attention);
  }
  void attention_backward() {
    const auto& t = weights.tables;
    Attention::backward_gaze(agent.config, frames, missions, cache.alpha, cache.dscale,
                             cache.attention, cache.dalpha);
    Vision::with_score_gradients(agent, t.vision, t.attention.probes, cache.vision,
                                 grads.tables.vision, grads.tables.attention.probes,
                                 [&](const auto& counts, auto&& take) {
                                   Attention::backward_words(agent.config, counts, frames, missions,
                                                             cache.alpha, cache.attention, take);
                                 });
  }
};

#define WORDGAZE_BENCHMARK(piece)                                   \
  BENCHMARK_F(Network, piece)(benchmark::State & state) {           \
    for (auto _ : state) Network::piece();                          \
    state.SetItemsProcessed(state.iterations() * kShape.columns()); \
  }
WORDGAZE_BENCHMARK(forward)
WORDGAZE_BENCHMARK(backward)
WORDGAZE_BENCHMARK(attention_forward)
WORDGAZE_BENCHMARK(attention_backward)

}  // namespace
