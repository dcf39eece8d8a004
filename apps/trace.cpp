#include <fmt/format.h>
#include <fmt/ostream.h>
#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/bot/policy.hpp"
#include "wordgaze/trace/level_docs.hpp"
#include "wordgaze/trace/record.hpp"
#include "wordgaze/trace/replay.hpp"

// Reads and writes traces of episodes, and compares the simulator with the reference's.
namespace {

using namespace wordgaze;

// "A:B" as the half-open range of seeds [A, B).
void parse_seeds(const std::string& text, trace::RecordOptions& options) {
  std::istringstream in(text);
  char colon = 0;
  in >> options.first_seed >> colon >> options.end_seed;
  if (!in || colon != ':' || !in.eof() || options.first_seed < 0 ||
      options.end_seed <= options.first_seed) {
    throw std::invalid_argument(
        fmt::format("--seeds {}: expected A:B with 0 <= A < B, for the seeds A to B - 1", text));
  }
}

int replay(const std::string& path) {
  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file) throw std::runtime_error(fmt::format("cannot read '{}'", path));
  }
  const trace::ReplayReport report = trace::replay(path == "-" ? std::cin : file, std::cerr);
  fmt::print("envs {} resets {} steps {} mismatches {}\n", report.envs, report.resets, report.steps,
             report.mismatches);
  return report.mismatches == 0 ? 0 : 1;
}

int record(const trace::RecordOptions& options, const std::string& path) {
  std::ofstream file;
  if (path != "-") {
    file.open(path);
    if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", path));
  }
  std::ostream& out = path == "-" ? std::cout : file;
  trace::record(options, out);
  out.flush();
  if (!out) throw std::runtime_error(fmt::format("could not write all of '{}'", path));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Replay reference traces, or record our own"};
  std::string replayed, out = "-", seeds = "0:4";
  trace::RecordOptions options;
  auto* replay_option = app.add_option("--replay", replayed,
                                       "Compare the simulator with a trace ('-': standard input)");
  auto* env_option = app.add_option("--env", options.ids, "Record these ids (all: every known one)")
                         ->delimiter(',')
                         ->excludes(replay_option);
  app.add_option("--seeds", seeds, "A:B, one stream of episodes for each seed from A to B - 1")
      ->needs(env_option);
  app.add_option("--policy", options.policy_name, "Who acts; mixed: the bot for even seeds")
      ->check(CLI::IsMember({"random", "bot", "mixed"}))
      ->needs(env_option);
  app.add_option("--policy-seed", options.policy_seed, "Varies the policy")->needs(env_option);
  app.add_option("--steps", options.steps, "Steps for each seed")
      ->check(CLI::NonNegativeNumber)
      ->needs(env_option);
  app.add_option("--out", out, "Where to write ('-': standard output)")->needs(env_option);
  app.add_flag("--done-actions", options.done_actions, "The reference's done mode")
      ->needs(env_option);
  bool list = false, levels = false;
  app.add_flag("--list", list, "Print all known ids");
  app.add_flag("--levels", levels, "Print the table of levels, docs/levels.md");
  CLI11_PARSE(app, argc, argv);

  try {
    if (list) {
      for (const std::string& id : babyai::level_ids()) fmt::print("{}\n", id);
      return 0;
    }
    if (levels) {
      trace::write_level_docs(std::cout);
      return 0;
    }
    if (*replay_option) return replay(replayed);
    if (!*env_option) throw std::invalid_argument("expected --replay FILE or --env ID");
    if (options.ids == std::vector<std::string>{"all"}) options.ids = babyai::level_ids();
    parse_seeds(seeds, options);
    options.policy = bot::policy_maker(options.policy_name);
    return record(options, out);
  } catch (const std::exception& error) {
    fmt::print(std::cerr, "trace: {}\n", error.what());
    return 2;
  }
}
