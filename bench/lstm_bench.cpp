// The memory over one minibatch: 32 sequences of 20 steps.
#include <benchmark/benchmark.h>

#include "wordgaze/nn/lstm.hpp"

namespace {

using namespace wordgaze;
using Layer = nn::Lstm<float>;

constexpr Index kHidden = 64;
constexpr nn::SequenceShape kShape{.steps = 20, .batch = 32};

struct Lstm : benchmark::Fixture {
  Layer::Params params, grads;
  Layer::State start;
  Layer::Cache cache;
  Matrix<float> input = Matrix<float>::Random(4 * kHidden, kShape.columns());
  Matrix<float> keep = Matrix<float>::Ones(1, kShape.columns());
  Matrix<float> h{kHidden, kShape.columns()}, dproduct{4 * kHidden, kShape.columns()};
  Matrix<float> dh = Matrix<float>::Random(kHidden, kShape.columns());

  Lstm() {
    Layer::resize(0, kHidden, params);  // the input's product is not this layer's
    params.hidden_weight = 0.1f * Matrix<float>::Random(4 * kHidden, kHidden);
    params.bias.setZero();
    grads = params;
    start.resize(kHidden, kShape.batch);
    cache.resize(kHidden, kShape);
  }
  void forward() { Layer::forward(params, kShape, input, keep, start, cache, h); }
};

BENCHMARK_F(Lstm, forward)(benchmark::State& state) {
  for (auto _ : state) forward();
  state.SetItemsProcessed(state.iterations() * kShape.columns());
}

BENCHMARK_F(Lstm, backward)(benchmark::State& state) {
  forward();
  for (auto _ : state) Layer::backward(params, kShape, keep, dh, cache, grads, dproduct);
  state.SetItemsProcessed(state.iterations() * kShape.columns());
}

}  // namespace
