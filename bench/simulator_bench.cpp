// One environment: a new episode, a step with a random action, a view.
#include <benchmark/benchmark.h>

#include <array>

#include "wordgaze/env/environment.hpp"

namespace {

using namespace wordgaze;

void reset(benchmark::State& state, const char* id) {
  env::Environment environment(id);
  environment.reset(1);
  for (auto _ : state) environment.reset();
  state.SetItemsProcessed(state.iterations());
}

void step(benchmark::State& state, const char* id) {
  env::Environment environment(id);
  environment.reset(1);
  core::Rng rng(1);
  std::array<grid::Action, 4096> actions;
  for (auto& a : actions) a = static_cast<grid::Action>(rng.below(environment.num_actions()));
  std::size_t k = 0;
  for (auto _ : state) {
    const auto transition = environment.step(actions[k++ % actions.size()]);
    if (transition.terminated || transition.truncated) environment.reset();
  }
  state.SetItemsProcessed(state.iterations());
}

void view(benchmark::State& state, const char* id) {
  env::Environment environment(id);
  environment.reset(1);
  std::array<std::uint8_t, grid::kImageBytes> image{};
  for (auto _ : state) {
    environment.observe(image);
    benchmark::DoNotOptimize(image);
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK_CAPTURE(reset, GoToLocal, "BabyAI-GoToLocal-v0");
BENCHMARK_CAPTURE(reset, BossLevel, "BabyAI-BossLevel-v0");
BENCHMARK_CAPTURE(step, GoToLocal, "BabyAI-GoToLocal-v0");
BENCHMARK_CAPTURE(step, BossLevel, "BabyAI-BossLevel-v0");
BENCHMARK_CAPTURE(view, GoToLocal, "BabyAI-GoToLocal-v0");
BENCHMARK_CAPTURE(view, BossLevel, "BabyAI-BossLevel-v0");

}  // namespace
