// bench: how fast the simulator, training and a single decision are on this machine. The last line
// of the output is one JSON object.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "command.hpp"
#include "output.hpp"
#include "own_level.hpp"
#include "wordgaze/env/vector_env.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/training/trainer.hpp"

namespace {

using namespace wordgaze;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::string sim, reset, train, act;
  std::vector<std::string> levels;
  int envs = 256, threads = 1;
  double seconds = 3;
  std::int64_t steps = 0, frames = 0;  // 0: as many as fit in `seconds`
};

void add_options(CLI::App& app, Arguments& a) {
  auto* what = app.add_option_group("what to measure");
  what->add_option("--sim", a.sim, "environment id: steps with random actions, views and resets");
  what->add_option("--reset", a.reset, "environment id: new episodes of one environment, no views");
  what->add_option("--train", a.train, "TOML file: the whole training loop");
  what->add_option("--act", a.act, "TOML file: one decision for one robot");
  what->require_option(1);
  apps::add_level_option(app, a.levels, "that --sim or --reset names by its id");
  app.add_option("--envs", a.envs, "environments of --sim")
      ->check(apps::whole_number(1, 10'000'000));
  app.add_option("--seconds", a.seconds, "at least")->check(CLI::Range(0.01, 3600.0));
  app.add_option("--steps", a.steps, "of --sim, in place of --seconds: at least")
      ->check(apps::whole_number(1, 1'000'000'000));
  app.add_option("--frames", a.frames, "of --train, in place of --seconds: at least")
      ->check(apps::whole_number(1, 1'000'000'000));
  app.add_option("--threads", a.threads, "workers")->check(apps::whole_number(1, 256));
}

/// Wall and CPU time (of all threads) since its making.
class Stopwatch {
 public:
  double wall() const { return now(CLOCK_MONOTONIC) - wall_; }
  double cpu() const { return now(CLOCK_PROCESS_CPUTIME_ID) - cpu_; }

 private:
  static double now(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double wall_ = now(CLOCK_MONOTONIC), cpu_ = now(CLOCK_PROCESS_CPUTIME_ID);
};

/// Whether to go on: until a count is reached or, without one, until the time is up. Throws
/// io::Stopped after a signal.
bool unfinished(std::int64_t done, std::int64_t wanted, double seconds, const Stopwatch& watch) {
  io::StopSignals::check();
  return wanted > 0 ? done < wanted : watch.wall() < seconds;
}

void report(const char* unit, double count, const Stopwatch& watch, Json& json) {
  json[unit] = count;
  json["cpu_seconds"] = watch.cpu();
  json["wall_seconds"] = watch.wall();
  apps::say("{:.4g} {} per CPU second, {:.4g} per second\n", count / watch.cpu(), unit,
            count / watch.wall());
}

Json simulate(const Arguments& a) {
  const auto level = babyai::find_level(a.sim);
  Team team(a.threads);
  env::VectorEnv batch(level, a.envs, team);
  const auto size = static_cast<std::size_t>(a.envs);
  std::vector<std::uint8_t> images(size * grid::kImageBytes), directions(size);
  std::vector<std::uint8_t> terminated(size), truncated(size);
  std::vector<double> rewards(size);
  const env::BatchOutput out{.images = images,
                             .directions = directions,
                             .rewards = rewards,
                             .terminated = terminated,
                             .truncated = truncated,
                             .final_images = {},
                             .final_directions = {}};
  // Actions are drawn before the clock runs: their cost is nobody's.
  core::Rng rng(1);
  std::vector<grid::Action> actions(size + 4096);
  for (auto& action : actions) action = static_cast<grid::Action>(rng.below(level.actions));
  batch.reset(0, out);

  const Stopwatch watch;
  std::int64_t steps = 0;
  while (unfinished(steps, a.steps, a.seconds, watch)) {
    for (int k = 0; k < 16; ++k) {
      const auto offset = static_cast<std::size_t>(rng.below(4096));
      batch.step(std::span(actions).subspan(offset, size), out);
    }
    steps += 16 * std::int64_t{a.envs};
  }
  Json json{{"bench", "sim"}, {"env", a.sim}, {"envs", a.envs}, {"threads", a.threads}};
  std::int64_t resets = 0;
  for (int k = 0; k < a.envs; ++k) resets += batch.statistics(k).episodes;
  json["resets"] = resets;
  report("steps", static_cast<double>(steps), watch, json);
  return json;
}

Json reset(const Arguments& a) {
  env::Environment environment(a.reset);
  environment.reset(0);
  const Stopwatch watch;
  std::int64_t resets = 0;
  for (; unfinished(resets, 0, a.seconds, watch); resets += 64) {
    for (int k = 0; k < 64; ++k) environment.reset();
  }
  Json json{{"bench", "reset"}, {"env", a.reset}};
  report("resets", static_cast<double>(resets), watch, json);
  return json;
}

Json train(const Arguments& a) {
  auto config = io::read_config<training::TrainConfig>(a.train);
  config.threads = a.threads;
  config.frames = std::max(config.frames, a.frames);  // the schedules of a whole run
  training::Trainer trainer(config);
  trainer.update();  // sizes every cache
  const std::int64_t before = trainer.frames();
  const Stopwatch watch;
  while (unfinished(trainer.frames() - before, a.frames, a.seconds, watch)) trainer.update();
  Json json{{"bench", "train"}, {"config", a.train}, {"threads", a.threads}};
  report("frames", static_cast<double>(trainer.frames() - before), watch, json);
  return json;
}

Json act(const Arguments& a) {
  const auto config = io::read_config<training::TrainConfig>(a.act);
  const training::Trainer trainer(config);
  policy::NetworkPolicy<policy::Agent> agent(trainer.agent(), trainer.weights());
  env::Environment environment(trainer.level());
  policy::Observation observation;
  core::Rng rng(1);
  environment.reset(0);
  std::vector<double> micros;
  const Stopwatch watch;
  while (unfinished(0, 0, a.seconds, watch)) {
    const auto begin = std::chrono::steady_clock::now();
    policy::observe(environment, observation);
    agent.observe(0, observation);
    const auto action = agent.decide(policy::Sampled{rng})[0].as_action();
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    micros.push_back(time.count());
    const auto transition = environment.step(action);
    if (transition.terminated || transition.truncated) {
      environment.reset();
      agent.begin(0);
    }
  }
  std::sort(micros.begin(), micros.end());
  const auto quantile = [&](double q) {
    return micros[static_cast<std::size_t>(q * static_cast<double>(micros.size() - 1))];
  };
  Json json{{"bench", "act"},
            {"config", a.act},
            {"median_us", quantile(0.5)},
            {"p99_us", quantile(0.99)}};
  report("decisions", static_cast<double>(micros.size()), watch, json);
  return json;
}

int run(const Arguments& a) {
  const io::StopSignals signals("\nbench: stopping; again to stop at once\n");
  for (const auto& file : a.levels) apps::register_level_file(file);
  const Json json = !a.sim.empty()     ? simulate(a)
                    : !a.reset.empty() ? reset(a)
                    : !a.train.empty() ? train(a)
                                       : act(a);
  apps::say("{}\n", json.dump());
  return 0;
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::bench_command() {
  return {"bench",
          "Measures rates: of the simulator, of training, of a single decision. Rates per CPU\n"
          "second do not suffer from a shared machine. The last line is one JSON object.",
          [](CLI::App& app) {
            const auto arguments = std::make_shared<Arguments>();
            add_options(app, *arguments);
            return [arguments] { return run(*arguments); };
          }};
}
