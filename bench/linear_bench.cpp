// A linear layer of the heads' size over one minibatch.
#include <benchmark/benchmark.h>

#include "wordgaze/nn/linear.hpp"

namespace {

using namespace wordgaze;
using Layer = nn::Linear<float>;

constexpr Index kIn = 96, kOut = 64, kColumns = 640;

struct Linear : benchmark::Fixture {
  Layer::Params params, grads;
  Matrix<float> x = Matrix<float>::Random(kIn, kColumns), dx = x;
  Matrix<float> y = Matrix<float>::Random(kOut, kColumns), dy = y;

  Linear() {
    Layer::resize(kIn, kOut, params);
    params.weight.setRandom();
    params.bias.setRandom();
    grads = params;
  }
};

BENCHMARK_F(Linear, forward)(benchmark::State& state) {
  for (auto _ : state) Layer::forward(params, x, {}, y);
  state.SetItemsProcessed(state.iterations() * kColumns);
}

BENCHMARK_F(Linear, backward)(benchmark::State& state) {
  for (auto _ : state) Layer::backward(params, x, dy, {}, grads, dx);
  state.SetItemsProcessed(state.iterations() * kColumns);
}

}  // namespace
