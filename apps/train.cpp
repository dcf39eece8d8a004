// train: from a configuration to a trained agent, its metrics and its checkpoint.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>

#include "listeners.hpp"
#include "wordgaze/io/checkpoint.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/csv_log.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/progress.hpp"

namespace {

using namespace wordgaze;
namespace fs = std::filesystem;

volatile std::sig_atomic_t interrupted = 0;

struct Arguments {
  std::string config, out, init;
  std::vector<std::string> set;
  std::string seed, frames, threads;
  bool resume = false;
  apps::Listeners::Options listeners;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Trains an agent that follows a sentence.\n"
      "Settings come from the defaults, then --config, then --set and the options below; the\n"
      "result is written to OUT/config.toml. docs/configuration.md lists every setting."};
  app.set_version_flag("--version", WORDGAZE_VERSION);
  app.add_option("--config", a.config, "TOML file of settings, as configs/single.toml");
  app.add_option("--out", a.out, "folder for config.toml, metrics.csv and checkpoint.safetensors")
      ->required();
  app.add_option("--seed", a.seed, "the same as --set seed=S");
  app.add_option("--frames", a.frames, "the same as --set frames=N");
  app.add_option("--threads", a.threads, "the same as --set threads=T");
  app.add_option("--init", a.init, "checkpoint whose weights to start from (a second phase)");
  app.add_flag("--resume", a.resume, "go on from OUT/checkpoint.safetensors");
  app.add_option("--set", a.set, "section.key=value, as often as wanted")
      ->allow_extra_args(true)
      ->type_name("KEY=VALUE ...");
  app.add_option("--lcm-log", a.listeners.log, "LCM log of metrics and of a sample of episodes");
  app.add_option("--lcm-url", a.listeners.url, "publish the same live, as udpm://");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return a;
}

rl::TrainConfig resolve(const Arguments& a) {
  rl::TrainConfig config;
  if (!a.config.empty()) config = io::read_config<rl::TrainConfig>(a.config);
  for (const auto& assignment : a.set) io::set_option(config, assignment);
  if (!a.seed.empty()) io::set_option(config, "seed=" + a.seed);
  if (!a.frames.empty()) io::set_option(config, "frames=" + a.frames);
  if (!a.threads.empty()) io::set_option(config, "threads=" + a.threads);
  rl::validate(config);
  return config;
}

/// Refuses to mix runs in one folder.
void check_folder(const Arguments& a, const rl::TrainConfig& config, const fs::path& checkpoint) {
  const fs::path out = a.out;
  if (fs::exists(out) && !fs::is_directory(out)) {
    throw std::invalid_argument("--out '" + a.out + "' is a file; give a folder");
  }
  if (fs::exists(out / "config.toml")) {
    auto before = io::read_config<rl::TrainConfig>(out / "config.toml");
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

void start(rl::Trainer& trainer, const Arguments& a, const fs::path& checkpoint) {
  if (a.resume) {
    trainer.restore(io::load_state(checkpoint, trainer.config()));
  } else if (!a.init.empty()) {
    trainer.set_params(io::load_params(a.init, trainer.config().model, &trainer.params()));
  }
}

std::string details(const rl::Metrics& m) {
  return fmt::format("success {:.3f}, return {:.3f}, entropy {:.3f}, hit {:.2f}", m.success_rate,
                     m.mean_return, m.entropy, m.hit);
}

int run(const Arguments& a) {
  const rl::TrainConfig config = resolve(a);
  const fs::path out = a.out, checkpoint = out / "checkpoint.safetensors";
  check_folder(a, config, checkpoint);
  rl::Trainer trainer(config);
  start(trainer, a, checkpoint);

  auto options = a.listeners;
  options.run_id = out.filename().string() + "-" + std::to_string(config.seed);
  options.every = config.log_episodes;
  options.append = a.resume;
  apps::Listeners listeners(options);

  fs::create_directories(out);
  io::write_file(out / "config.toml", io::to_toml(config));
  const auto columns = rl::Metrics::columns();
  auto log = a.resume ? io::CsvLog::resume(out / "metrics.csv", columns, "frames",
                                           static_cast<double>(trainer.frames()))
                      : io::CsvLog(out / "metrics.csv", columns);

  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  {
    io::Progress progress("frames", trainer.frames(), config.frames);
    while (!trainer.finished() && !interrupted) {
      const rl::Metrics metrics = trainer.update(listeners.observer());
      const auto row = metrics.values();
      log.append(row);
      if (auto* observer = listeners.observer()) {
        std::vector<rl::Scalar> scalars;
        for (std::size_t i = 0; i < row.size(); ++i) scalars.push_back({columns[i], row[i]});
        observer->on_update({trainer.updates(), trainer.frames(), scalars});
      }
      progress.update(std::min(trainer.frames(), config.frames), details(metrics));
      if (trainer.updates() % config.checkpoint_every == 0) {
        io::save_checkpoint(checkpoint, config, trainer.state());
      }
    }
  }
  io::save_checkpoint(checkpoint, config, trainer.state());
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

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "train: {}\n", error.what());
    return 1;
  }
}
