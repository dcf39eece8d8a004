// The text encoder's memory over the missions of one minibatch: 32 of 5 words.
#include <benchmark/benchmark.h>

#include "wordgaze/nn/gru.hpp"

namespace {

using namespace wordgaze;
using Layer = nn::Gru<float>;

constexpr Index kHidden = 32;
constexpr nn::SequenceShape kShape{.steps = 5, .batch = 32};

struct Gru : benchmark::Fixture {
  Layer::Params params, grads;
  Layer::Cache cache;
  Matrix<float> input = Matrix<float>::Random(3 * kHidden, kShape.columns());
  Matrix<float> active = Matrix<float>::Ones(1, kShape.columns());
  Matrix<float> h{kHidden, kShape.batch}, dproduct{3 * kHidden, kShape.columns()};
  Matrix<float> dh = Matrix<float>::Random(kHidden, kShape.batch);

  Gru() {
    Layer::resize(0, kHidden, params);  // the input's product is not this layer's
    params.hidden_weight = 0.1f * Matrix<float>::Random(3 * kHidden, kHidden);
    params.bias.setZero();
    params.candidate_bias.setZero();
    grads = params;
  }
  void forward() { Layer::forward(params, kShape, input, active, cache, h); }
};

BENCHMARK_F(Gru, forward)(benchmark::State& state) {
  for (auto _ : state) forward();
  state.SetItemsProcessed(state.iterations() * kShape.batch);
}

BENCHMARK_F(Gru, backward)(benchmark::State& state) {
  forward();
  for (auto _ : state) {
    Layer::backward(params, kShape, active, dh, cache, grads, dproduct);
  }
  state.SetItemsProcessed(state.iterations() * kShape.batch);
}

}  // namespace
