// trace: reads and writes traces of episodes, and compares the simulator with the reference's.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "output.hpp"
#include "own_level.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/bot/policy.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/file_stream.hpp"
#include "wordgaze/io/output_check.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/trace/record.hpp"
#include "wordgaze/trace/replay.hpp"

namespace {

using namespace wordgaze;

struct Arguments {
  std::string replayed, checkpoint, out = "-", seeds = "0:4";
  std::vector<std::string> levels;
  bool greedy = false;
  trace::RecordOptions record;
};

// "A:B" as the half-open range of seeds [A, B).
void parse_seeds(const std::string& text, trace::RecordOptions& options) {
  const std::size_t colon = text.find(':');
  const auto first = number_in<std::int64_t>(text.substr(0, colon));
  const auto end = number_in<std::int64_t>(text.substr(std::min(colon, text.size() - 1) + 1));
  require(colon != text.npos && first && end && *first >= 0 && *end > *first,
          "--seeds {}: expected A:B with 0 <= A < B, for the seeds A to B - 1", shortened(text));
  options.first_seed = *first;
  options.end_seed = *end;
}

int replay(const std::string& path) {
  std::ifstream file;
  if (path == "-") {
    std::ios::sync_with_stdio(false);  // nobody else reads it: in large pieces, then
  } else {
    io::expect_regular(path);
    file.open(path);
    if (!file) throw std::runtime_error(fmt::format("cannot read '{}'", path));
  }
  const trace::ReplayReport report = trace::replay(path == "-" ? std::cin : file, std::cerr);
  apps::say("envs {} resets {} steps {} mismatches {}\n", report.envs, report.resets, report.steps,
            report.mismatches);
  if (report.resets == 0) {
    throw std::runtime_error(fmt::format("'{}' holds no episode: nothing was compared", path));
  }
  return report.mismatches == 0 ? 0 : 1;
}

/// The same policies, with a look between two actions whether to go on.
env::PolicyMaker with_checks(env::PolicyMaker maker, std::function<void()> check) {
  return [=](std::string_view id, std::uint64_t seed, std::uint64_t policy_seed) -> env::Policy {
    return [=, policy = maker(id, seed, policy_seed)](const env::Environment& environment) {
      check();
      return policy(environment);
    };
  };
}

/// An agent with the cells of the level that it acts in, as eval has it.
env::PolicyMaker agent_maker(const std::string& checkpoint, bool greedy) {
  std::string of;
  env::PolicyMaker maker;
  return [=](std::string_view id, std::uint64_t seed, std::uint64_t policy_seed) mutable {
    if (of != id) {
      maker = policy::EnvironmentPolicy::maker(
          std::make_shared<policy::TrainedAgent>(
              policy::TrainedAgent::load(checkpoint, policy::alphabet_of(babyai::find_level(id)))),
          greedy);
      of = id;
    }
    return maker(id, seed, policy_seed);
  };
}

int record(trace::RecordOptions options, const std::string& path) {
  const io::StopSignals signals("\ntrace: stopping; again to stop at once\n");
  if (path == "-") {
    options.policy = with_checks(options.policy, io::StopSignals::check);
    trace::record(options, std::cout);
    return 0;
  }
  io::FileStream file(path);
  options.policy = with_checks(options.policy, [&file] {
    io::StopSignals::check();
    file.check();
  });
  trace::record(options, file.stream());
  file.commit();
  return 0;
}

void add_options(CLI::App& app, Arguments& a) {
  auto* replay = app.add_option("--replay", a.replayed,
                                "compare the simulator with a trace ('-': standard input)");
  app.add_option("--env", a.record.ids, "record these ids (all: every known one)")
      ->delimiter(',')
      ->excludes(replay);
  apps::add_level_option(app, a.levels, "to record, or to know in a replay");
  app.add_option("--seeds", a.seeds, "A:B, one stream of episodes for each seed from A to B - 1")
      ->excludes(replay);
  auto* policy =
      app.add_option("--policy", a.record.policy_name, "who acts; mixed: the bot for even seeds")
          ->check(CLI::IsMember({"random", "bot", "mixed"}))
          ->excludes(replay);
  auto* checkpoint =
      app.add_option("--checkpoint", a.checkpoint, "an agent acts: file that train has written")
          ->excludes(replay)
          ->excludes(policy);
  app.add_flag("--greedy", a.greedy, "the agent's likeliest actions, not drawn ones")
      ->needs(checkpoint);
  app.add_option("--policy-seed", a.record.policy_seed, "varies the policy")
      ->check(apps::whole_number<std::uint64_t>(0))
      ->excludes(replay);
  app.add_option("--steps", a.record.steps, "steps for each seed")
      ->check(apps::whole_number(0))
      ->excludes(replay);
  app.add_option("--out", a.out, "where to write ('-': standard output)")->excludes(replay);
  app.add_flag("--done-actions", a.record.done_actions, "the reference's done mode")
      ->excludes(replay);
}

int run(Arguments a) {
  for (const auto& file : a.levels) {
    const std::string id = apps::register_level_file(file);
    if (a.replayed.empty()) a.record.ids.push_back(id);
  }
  if (!a.replayed.empty()) return replay(a.replayed);
  require(!a.record.ids.empty(), "expected --replay FILE, --env ID or --level FILE");
  parse_seeds(a.seeds, a.record);
  if (a.record.ids == std::vector<std::string>{"all"}) a.record.ids = babyai::level_ids();
  for (const auto& id : a.record.ids) babyai::find_level(id);  // before anything is written
  io::check_outputs(std::array{io::NamedPath{"--out", a.out == "-" ? "" : a.out}},
                    std::array{io::NamedPath{"--checkpoint", a.checkpoint}});
  if (a.checkpoint.empty()) {
    a.record.policy = bot::policy_maker(a.record.policy_name);
  } else {
    a.record.policy_name = a.greedy ? "agent, greedy" : "agent, sampled";
    a.record.policy = agent_maker(a.checkpoint, a.greedy);
  }
  return record(std::move(a.record), a.out);
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::trace_command() {
  return {"trace", "Replays traces of episodes, the reference's or our own, or records them.",
          [](CLI::App& app) {
            const auto arguments = std::make_shared<Arguments>();
            add_options(app, *arguments);
            return [arguments] { return run(*arguments); };
          }};
}
