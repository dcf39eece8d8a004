// Training with the defaults (configs/single.toml): one decision, for one robot and for all lanes,
// and one whole update. Items are frames.
#include <benchmark/benchmark.h>

#include "wordgaze/policy/environment.hpp"
#include "wordgaze/training/trainer.hpp"

namespace {

using namespace wordgaze;

training::TrainConfig one_thread() {
  training::TrainConfig config;
  config.threads = 1;
  config.probe_every = 0;
  return config;
}

void act(benchmark::State& state) {
  const training::Trainer trainer(one_thread());
  const auto lanes = static_cast<int>(state.range(0));
  policy::NetworkPolicy<policy::Agent> policy(trainer.agent(), trainer.weights(), lanes);
  env::Environment environment(trainer.level());
  for (int lane = 0; lane < lanes; ++lane) {
    environment.reset(lane);
    policy.observe(lane, policy::observe(environment));
  }
  for (auto _ : state) policy.decide(policy::Greedy{});
  state.SetItemsProcessed(state.iterations() * lanes);
}
BENCHMARK(act)->Arg(1)->Arg(128);

void update(benchmark::State& state) {
  training::Trainer trainer(one_thread());
  trainer.update();  // sizes every cache
  const std::int64_t before = trainer.frames();
  for (auto _ : state) trainer.update();
  state.SetItemsProcessed(trainer.frames() - before);
}
BENCHMARK(update)->Unit(benchmark::kMillisecond);

}  // namespace
