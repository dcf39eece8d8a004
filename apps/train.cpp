// train: from a configuration to a trained agent, its metrics and its checkpoint.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "listeners.hpp"
#include "output.hpp"
#include "tensorboard.hpp"
#include "watch.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/csv_log.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/folder_lock.hpp"
#include "wordgaze/io/output_check.hpp"
#include "wordgaze/io/progress.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/policy/level_file.hpp"
#include "wordgaze/training/checkpoint.hpp"
#include "wordgaze/training/resume.hpp"

namespace {

using namespace wordgaze;
using training::TrainConfig;
namespace fs = std::filesystem;

struct Arguments {
  std::string config, level, out, init, tensorboard;
  std::vector<std::string> set;
  std::string seed, frames, threads;
  bool resume = false;
  apps::Watch watch;
  apps::Listeners::Options listeners;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--config", a.config, "TOML file of settings, as configs/single.toml");
  app.add_option("--level", a.level,
                 "TOML file of a level of one's own to train in (docs/own-level.md)")
      ->type_name("FILE");
  app.add_option("--out", a.out, "folder for config.toml, metrics.csv and checkpoint.safetensors")
      ->required();
  app.add_option("--seed", a.seed, "the same as --set seed=S")
      ->check(apps::whole_number<std::int64_t>(0, 9'000'000'000'000'000'000));
  app.add_option("--frames", a.frames, "the same as --set frames=N")
      ->check(apps::whole_number<std::int64_t>(1, 1'000'000'000'000'000));
  app.add_option("--threads", a.threads, "the same as --set threads=T")
      ->check(apps::whole_number(1, 256));
  app.add_option("--init", a.init, "checkpoint whose weights to start from (a second phase)");
  app.add_flag("--resume", a.resume,
               "go on from OUT/checkpoint.safetensors; from the start where there is none yet");
  app.add_option("--set", a.set, "section.key=value, as often as wanted")
      ->allow_extra_args(true)
      ->type_name("KEY=VALUE ...");
  app.add_option("--tensorboard", a.tensorboard,
                 "folder for the metrics as TensorBoard reads them, as runs/board/NAME");
  apps::Watch::add_options(app, a.watch);
  apps::Listeners::add_options(app, a.listeners, "LCM log of metrics and of a sample of episodes");
}

TrainConfig resolve(const Arguments& a) {
  TrainConfig config;
  if (!a.config.empty()) config = io::read_config<TrainConfig>(a.config);
  for (const auto& assignment : a.set) io::set_option(config, assignment);
  if (!a.seed.empty()) io::set_option(config, "seed=" + a.seed);
  if (!a.frames.empty()) io::set_option(config, "frames=" + a.frames);
  if (!a.threads.empty()) io::set_option(config, "threads=" + a.threads);
  if (!a.level.empty()) {
    const babyai::LevelSpec level = policy::load_level(a.level);
    config.env = level.id;
    config.level = io::to_toml(policy::read_level_file(a.level));
  }
  training::validate(config);
  return config;
}

/// The files of a run.
struct Folder {
  fs::path path;
  fs::path config = path / "config.toml", metrics = path / "metrics.csv",
           checkpoint = path / "checkpoint.safetensors";
};

/// Refuses to write over what is read.
void check_files(const Arguments& a, const Folder& out) {
  const std::array outputs{io::NamedPath{"--lcm-log", a.listeners.log}};
  const std::array inputs{
      io::NamedPath{"--config", a.config}, io::NamedPath{"--init", a.init},
      io::NamedPath{"--level", a.level},   io::NamedPath{"--out", out.config},
      io::NamedPath{"--out", out.metrics}, io::NamedPath{"--out", out.checkpoint}};
  io::check_outputs(outputs, inputs);
}

/// Refuses to mix runs in one folder.
void check_folder(const Arguments& a, const TrainConfig& config, const Folder& out) {
  const std::string place = fmt::format("--out '{}'", a.out);
  if (fs::exists(out.config)) {
    auto before = io::read_config<TrainConfig>(out.config);
    require(before.level.empty() || !config.level.empty(),
            "{} holds a run in the level '{}' of a file; give that file again, as --level FILE, or "
            "--config '{}'",
            place, before.env, out.config.string());
    training::check_same_run(place, before, config);
    // A longer run may go on where a shorter one ended.
    require(a.resume || before.frames == config.frames,
            "{} holds a run of {} frames, not of {}; give another --out, or add --resume", place,
            before.frames, config.frames);
  }
  if (!fs::exists(out.checkpoint)) return;
  require(a.resume,
          "{} holds a checkpoint already; add --resume to go on from it, or give another --out",
          place);
  training::check_same_run(fmt::format("'{}'", out.checkpoint.string()),
                           training::load_config(out.checkpoint), config);
}

/// Takes up the run of a folder.
void go_on(training::Trainer& trainer, const fs::path& checkpoint) {
  const TrainConfig before = training::load_config(checkpoint), &now = trainer.config();
  trainer.restore(training::load_state<policy::Agent>(checkpoint, trainer));
  training::check_frames(before, now, trainer.frames());
  const std::string changes = training::schedule_changes(before, now, trainer.frames());
  if (!changes.empty()) apps::note("train: {}\n", changes);
}

std::string details(const training::Metrics& m) {
  return fmt::format("success {:.3f}, return {:.3f}, entropy {:.3f}, hit {:.2f}", m.success_rate,
                     m.mean_return, m.entropy, m.hit);
}

int run(const Arguments& a) {
  const TrainConfig config = resolve(a);
  require(
      !a.resume || a.init.empty(),
      "--resume goes on with the weights in --out, --init starts from others; give one of them");
  require(!fs::exists(a.out) || fs::is_directory(a.out), "--out '{}' is a file; give a folder",
          a.out);
  training::Trainer trainer(config);
  if (!a.init.empty()) trainer.set_params(training::load_params<policy::Agent>(a.init, trainer));

  const Folder out{a.out};
  fs::create_directories(out.path);
  const io::FolderLock lock(out.path);
  check_files(a, out);
  check_folder(a, config, out);
  const bool goes_on = a.resume && fs::exists(out.checkpoint);
  if (goes_on) go_on(trainer, out.checkpoint);
  if (a.resume && !goes_on) {
    apps::note("train: '{}' has no checkpoint yet; starting from the beginning\n", a.out);
  }

  auto options = a.listeners;
  options.run_id = apps::run_name(out.path, config.seed);
  options.every = config.log_episodes;
  if (goes_on) options.update = trainer.updates();
  apps::Listeners listeners(options);
  const auto live = a.watch.open({.title = options.run_id, .every = config.log_episodes});
  if (live) live->on_run(options.run_id);
  policy::Observers observers;
  observers.add(listeners.observer());
  observers.add(live.get());
  std::optional<apps::TensorBoard> board;
  if (!a.tensorboard.empty()) {
    board.emplace(a.tensorboard, goes_on ? std::optional(trainer.frames() + 1) : std::nullopt);
    observers.add(&*board);
  }

  io::clear_temporaries(out.path, {"config.toml", "metrics.csv", "checkpoint.safetensors"});
  io::write_file(out.config, io::to_toml(config));
  const auto columns = trainer.columns();
  auto log = goes_on ? io::CsvLog::resume(out.metrics, columns, "frames",
                                          static_cast<double>(trainer.frames()))
                     : io::CsvLog(out.metrics, columns);
  if (!log.gap().empty()) apps::note("note: metrics.csv has a hole: {}\n", log.gap());
  trainer.set_seconds(log.last("seconds"));
  const auto save = [&] {
    log.sync();
    training::save_checkpoint(out.checkpoint, config, trainer.state());
  };
  if (!goes_on) save();  // however early the run ends, --resume goes on with these weights

  const io::StopSignals signals(
      "\ntrain: stopping after this update, everything will be saved; again to stop at once\n");
  {
    io::Progress progress("frames", trainer.frames(), config.frames);
    while (!trainer.finished() && signals.received() == 0) {
      const training::Metrics metrics = trainer.update(observers.or_null());
      try {
        log.append(metrics.values());
      } catch (...) {
        training::save_checkpoint(out.checkpoint, config, trainer.state());  // not the rows
        throw;
      }
      progress.update(std::min(trainer.frames(), config.frames), details(metrics));
      if (trainer.updates() % config.checkpoint_every == 0) save();
    }
  }
  save();
  if (!trainer.finished()) {
    apps::note(
        "stopped after {} frames; everything is saved in {}\n"
        "to go on, give the same command with --resume{}\n",
        trainer.frames(), out.checkpoint.string(), a.init.empty() ? "" : " in place of --init");
    return io::Stopped(signals.received()).exit_code();
  }
  apps::say("trained for {} frames; the agent is {}\n", trainer.frames(), out.checkpoint.string());
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
