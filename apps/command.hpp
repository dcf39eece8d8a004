#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <string_view>

/// The commands of the program wordgaze, each in a file of its own.
namespace wordgaze::apps {

/// A command adds its options to `app` and returns what runs once they are parsed; that returns the
/// exit code. What it throws becomes a message and an exit code in main().
struct Command {
  std::string_view name, about;
  std::function<std::function<int()>(CLI::App& app)> set_up;
};

Command train_command();
Command eval_command();
Command trace_command();
Command bench_command();
Command levels_command();

}  // namespace wordgaze::apps
