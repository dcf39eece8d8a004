// Training with the defaults (configs/single.toml): one decision, for one robot and for all lanes,
// and one whole update. Items are frames.
#include <benchmark/benchmark.h>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/training/trainer.hpp"

namespace {

using namespace wordgaze;

rl::TrainConfig one_thread() {
  rl::TrainConfig config;
  config.threads = 1;
  config.probe_every = 0;
  return config;
}

void act(benchmark::State& state) {
  const rl::TrainConfig config = one_thread();
  const rl::Trainer trainer(config);
  const rl::Agent& agent = trainer.agent();
  auto tables = agent.make_tables();
  agent.update_all_tables(trainer.params(), tables);
  const auto lanes = static_cast<int>(state.range(0));
  rl::Actor actor(agent, lanes);
  env::Environment environment(config.env);
  for (int lane = 0; lane < lanes; ++lane) {
    environment.reset(lane);
    actor.begin(lane, environment.sentence());
    actor.observe(lane, environment);
  }
  for (auto _ : state) {
    actor.decide(trainer.params(), tables);
    actor.advance();
  }
  state.SetItemsProcessed(state.iterations() * lanes);
}
BENCHMARK(act)->Arg(1)->Arg(128);

void update(benchmark::State& state) {
  rl::Trainer trainer(one_thread());
  trainer.update();  // sizes every cache
  const std::int64_t before = trainer.frames();
  for (auto _ : state) trainer.update();
  state.SetItemsProcessed(trainer.frames() - before);
}
BENCHMARK(update)->Unit(benchmark::kMillisecond);

}  // namespace
