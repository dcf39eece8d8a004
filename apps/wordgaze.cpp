// wordgaze: one program with a command for each task. Called by the name of a command (train, eval,
// trace, bench: links in the build folder) it is that command.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "command.hpp"

namespace {

using namespace wordgaze;

constexpr int kFailed = 1;  // something went wrong
constexpr int kBadUse = 2;  // the command line, or a value that the user gave

/// Parses, and runs what was asked for.
int parse_and_run(CLI::App& app, const std::function<int()>& run, int argc, char** argv) {
  app.set_version_flag("--version", "wordgaze " WORDGAZE_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUse;  // --help and --version are no errors
  }
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return kBadUse;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return kFailed;
  }
}

int run_alone(const apps::Command& command, int argc, char** argv) {
  CLI::App app{std::string(command.about), std::string(command.name)};
  const auto run = command.set_up(app);
  return parse_and_run(app, run, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  const std::array commands{apps::train_command(), apps::eval_command(), apps::trace_command(),
                            apps::bench_command(), apps::levels_command()};
  const std::string called = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  const auto named = std::ranges::find(commands, called, &apps::Command::name);
  if (named != commands.end()) return run_alone(*named, argc, argv);

  CLI::App app{"Language-guided robot learning that shows what it looks at.", "wordgaze"};
  app.require_subcommand(1);
  std::function<int()> chosen;
  for (const apps::Command& command : commands) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.about));
    sub->callback([&chosen, run = command.set_up(*sub)] { chosen = run; });
  }
  return parse_and_run(
      app, [&] { return chosen(); }, argc, argv);
}
