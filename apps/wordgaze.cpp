// wordgaze: one program with a command for each task. Called by the name of a command (train, eval,
// trace, bench: links in the build folder) it is that command.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>

#include "command.hpp"
#include "wordgaze/core/edit_distance.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/standard_streams.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/training/config.hpp"
#include "wordgaze/version.hpp"

namespace {

using namespace wordgaze;

constexpr int kFailed = 1;  // something went wrong
constexpr int kBadUse = 2;  // the command line, or a value that the user gave

/// No option means anything when it is empty: it comes of a variable of the shell that is not set.
void refuse_empty_options(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) continue;
    const auto& values = option->results();
    if (std::ranges::find(values, "") == values.end()) continue;
    throw std::invalid_argument(option->get_name() +
                                " is empty (a variable that is not set?); give it a value or leave "
                                "it out");
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_options(*command);
}

/// What may have been meant by an option that there is not: a setting of training, or the option
/// that is written most like it.
std::string meant_by(const CLI::App& command, const std::string& option) {
  if (!option.starts_with("--")) return "";
  const std::string name = option.substr(2, option.find('=') - 2);
  if (command.get_name() == "train") {
    const std::string key = io::key_named<training::TrainConfig>(name);
    if (!key.empty()) return "--set " + key + "=...";
  }
  std::string best;
  std::size_t least = 1 + name.size() / 2;
  for (const CLI::Option* known : command.get_options()) {
    const auto& names = known->get_lnames();
    if (names.empty() || edit_distance(name, names[0]) >= least) continue;
    least = edit_distance(name, names[0]);
    best = "--" + names[0];
  }
  return best;
}

/// No values by default are no default to speak of.
void leave_out_empty_defaults(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_default_str() == "[]") option->default_str("");
  }
}

/// The command whose arguments were not understood.
const CLI::App& innermost(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : innermost(*commands.front());
}

/// Parses, and runs what was asked for.
int parse_and_run(CLI::App& app, const std::function<int()>& run, int argc, char** argv) {
  app.set_version_flag("--version", "wordgaze " + std::string(kVersion));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    for (const std::string& extra : app.remaining(true)) {
      const std::string meant = meant_by(innermost(app), extra);
      if (!meant.empty())
        throw std::invalid_argument(extra + ": there is no such option; did you mean " + meant +
                                    "?");
    }
    app.exit(error);
    return kBadUse;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUse;  // --help and --version are no errors
  }
  refuse_empty_options(app);
  return run();
}

int run_alone(const apps::Command& command, int argc, char** argv) {
  CLI::App app{std::string(command.about), std::string(command.name)};
  app.option_defaults()->always_capture_default();
  const auto run = command.set_up(app);
  leave_out_empty_defaults(app);
  return parse_and_run(app, run, argc, argv);
}

/// The command that the program is called by, or that is its first argument.
int run_command(const std::string& called, int argc, char** argv) {
  const std::array commands{apps::train_command(), apps::eval_command(),   apps::trace_command(),
                            apps::bench_command(), apps::levels_command(), apps::page_command(),
                            apps::play_command(),  apps::serve_command()};
  const auto named = std::ranges::find(commands, called, &apps::Command::name);
  if (named != commands.end()) return run_alone(*named, argc, argv);

  CLI::App app{"Language-guided robot learning that shows what it looks at.", "wordgaze"};
  app.option_defaults()->always_capture_default();  // of the commands too
  app.require_subcommand(1);
  std::function<int()> chosen;
  for (const apps::Command& command : commands) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.about));
    const auto run = command.set_up(*sub);
    leave_out_empty_defaults(*sub);
    sub->callback([&chosen, run] { chosen = run; });
  }
  return parse_and_run(
      app, [&] { return chosen(); }, argc, argv);
}

/// Says what went wrong; where that cannot be written, the exit code has to do.
int fail(const std::string& program, const char* what, int code) noexcept {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), what);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  io::secure_standard_streams();
  std::string called = "wordgaze";
  try {
    if (argc > 0) called = std::filesystem::path(argv[0]).filename().string();
    const int code = run_command(called, argc, argv);
    return io::flush_standard_output() || code != 0 ? code : kFailed;
  } catch (const io::Stopped& stopped) {
    return fail(called, stopped.what(), stopped.exit_code());
  } catch (const std::invalid_argument& error) {
    return fail(called, error.what(), kBadUse);
  } catch (const std::bad_alloc&) {
    return fail(called, "out of memory; smaller sizes and fewer --threads need less", kFailed);
  } catch (const std::exception& error) {
    return fail(called, error.what(), kFailed);
  } catch (...) {
    return fail(called, "an error that does not say what it is", kFailed);
  }
}
