#pragma once
#include <CLI/CLI.hpp>
#include <concepts>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/number.hpp"

/// The commands of the program wordgaze, each in a file of its own.
namespace wordgaze::apps {

/// A command adds its options to `app` and returns what runs once they are parsed; that returns the
/// exit code. What it throws becomes a message and an exit code in main().
struct Command {
  std::string_view name, about;
  std::function<std::function<int()>(CLI::App& app)> set_up;
};

/// Accepts whole numbers from `low` to `high`, written as such or as 1e6: what the parser of the
/// command line would make of "-1", "" or "0x10" is not what was meant.
template <std::integral Number>
CLI::Validator whole_number(Number low, Number high = std::numeric_limits<Number>::max()) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto number = whole_number_in<Number>(text);
        if (number && *number >= low && *number <= high) {
          text = std::to_string(*number);
          return "";
        }
        return formatted("expected an integer from {} to {}; came '{}'", low, high,
                         shortened(text));
      },
      formatted("{} to {}", low, high));
}

Command train_command();
Command eval_command();
Command trace_command();
Command bench_command();
Command levels_command();
Command page_command();
Command play_command();
Command serve_command();

}  // namespace wordgaze::apps
