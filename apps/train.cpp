// train: from a configuration to a trained agent, its metrics and its checkpoint.
#include <fmt/core.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.hpp"
#include "listeners.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/csv_log.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/progress.hpp"
#include "wordgaze/training/checkpoint.hpp"

namespace {

using namespace wordgaze;
using training::TrainConfig;
namespace fs = std::filesystem;

volatile std::sig_atomic_t interrupted = 0;

struct Arguments {
  std::string config, out, init;
  std::vector<std::string> set;
  std::string seed, frames, threads;
  bool resume = false;
  apps::Listeners::Options listeners;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--config", a.config, "TOML file of settings, as configs/single.toml");
  app.add_option("--out", a.out, "folder for config.toml, metrics.csv and checkpoint.safetensors")
      ->required();
  app.add_option("--seed", a.seed, "the same as --set seed=S")
      ->check(apps::whole_number<std::int64_t>(0, 9'000'000'000'000'000'000));
  app.add_option("--frames", a.frames, "the same as --set frames=N")
      ->check(apps::whole_number<std::int64_t>(1, 1'000'000'000'000'000));
  app.add_option("--threads", a.threads, "the same as --set threads=T")
      ->check(apps::whole_number(1, 256));
  app.add_option("--init", a.init, "checkpoint whose weights to start from (a second phase)");
  app.add_flag("--resume", a.resume, "go on from OUT/checkpoint.safetensors");
  app.add_option("--set", a.set, "section.key=value, as often as wanted")
      ->allow_extra_args(true)
      ->type_name("KEY=VALUE ...");
  apps::Listeners::add_options(app, a.listeners, "LCM log of metrics and of a sample of episodes");
}

TrainConfig resolve(const Arguments& a) {
  TrainConfig config;
  if (!a.config.empty()) config = io::read_config<TrainConfig>(a.config);
  for (const auto& assignment : a.set) io::set_option(config, assignment);
  if (!a.seed.empty()) io::set_option(config, "seed=" + a.seed);
  if (!a.frames.empty()) io::set_option(config, "frames=" + a.frames);
  if (!a.threads.empty()) io::set_option(config, "threads=" + a.threads);
  training::validate(config);
  return config;
}

/// Refuses to mix runs in one folder.
void check_folder(const Arguments& a, const TrainConfig& config, const fs::path& checkpoint) {
  const fs::path out = a.out;
  if (fs::exists(out) && !fs::is_directory(out)) {
    throw std::invalid_argument("--out '" + a.out + "' is a file; give a folder");
  }
  if (fs::exists(out / "config.toml")) {
    auto before = io::read_config<TrainConfig>(out / "config.toml");
    if (a.resume) before.frames = config.frames;  // a longer run may go on where it ended
    const auto differences = io::differences(before, config);
    if (!differences.empty()) {
      std::string list;
      for (const auto& line : differences) list += "\n  " + line;
      throw std::invalid_argument("--out '" + a.out +
                                  "' holds a run with another configuration (there, here):" + list +
                                  "\ngive another --out, or the same settings with --resume");
    }
  }
  if (a.resume && !fs::exists(checkpoint)) {
    throw std::invalid_argument("--resume: there is no '" + checkpoint.string() +
                                "' to go on from; start without --resume");
  }
  if (!a.resume && fs::exists(checkpoint)) {
    throw std::invalid_argument("--out '" + a.out +
                                "' holds a checkpoint already; add --resume to go on from it, or "
                                "give another --out");
  }
}

void start(training::Trainer& trainer, const Arguments& a, const fs::path& checkpoint) {
  if (a.resume) {
    trainer.restore(training::load_state<policy::Agent>(checkpoint, trainer));
  } else if (!a.init.empty()) {
    trainer.set_params(training::load_params<policy::Agent>(a.init, trainer));
  }
}

std::string details(const training::Metrics& m) {
  return fmt::format("success {:.3f}, return {:.3f}, entropy {:.3f}, hit {:.2f}", m.success_rate,
                     m.mean_return, m.entropy, m.hit);
}

int run(const Arguments& a) {
  const TrainConfig config = resolve(a);
  const fs::path out = a.out, checkpoint = out / "checkpoint.safetensors";
  check_folder(a, config, checkpoint);
  training::Trainer trainer(config);
  start(trainer, a, checkpoint);

  auto options = a.listeners;
  options.run_id = apps::run_name(out, config.seed);
  options.every = config.log_episodes;
  if (a.resume) options.update = trainer.updates();
  fs::create_directories(out);  // before the listeners: the log may lie there
  apps::Listeners listeners(options);

  io::clear_temporaries(out, {"config.toml", "metrics.csv", "checkpoint.safetensors"});
  io::write_file(out / "config.toml", io::to_toml(config));
  const auto columns = trainer.columns();
  auto log = a.resume ? io::CsvLog::resume(out / "metrics.csv", columns, "frames",
                                           static_cast<double>(trainer.frames()))
                      : io::CsvLog(out / "metrics.csv", columns);
  if (!log.gap().empty()) fmt::print(stderr, "note: metrics.csv has a hole: {}\n", log.gap());
  trainer.set_seconds(log.last("seconds"));

  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  {
    io::Progress progress("frames", trainer.frames(), config.frames);
    while (!trainer.finished() && !interrupted) {
      const training::Metrics metrics = trainer.update(listeners.observer());
      log.append(metrics.values());
      progress.update(std::min(trainer.frames(), config.frames), details(metrics));
      if (trainer.updates() % config.checkpoint_every == 0) {
        log.sync();
        training::save_checkpoint(checkpoint, config, trainer.state());
      }
    }
  }
  log.sync();
  training::save_checkpoint(checkpoint, config, trainer.state());
  if (!trainer.finished()) {
    fmt::print(stderr,
               "stopped after {} frames; everything is saved in {}\n"
               "to go on, give the same command with --resume\n",
               trainer.frames(), checkpoint.string());
    return 130;
  }
  fmt::print("trained for {} frames; the agent is {}\n", trainer.frames(), checkpoint.string());
  return 0;
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::train_command() {
  return {"train",
          "Trains an agent that follows a sentence.\n"
          "Settings come from the defaults, then --config, then --set and the options below; the\n"
          "result is written to OUT/config.toml. docs/configuration.md lists every setting.",
          [](CLI::App& app) {
            const auto arguments = std::make_shared<Arguments>();
            add_options(app, *arguments);
            return [arguments] { return run(*arguments); };
          }};
}
