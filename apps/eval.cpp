// eval: how well a trained agent does, in the room it knows and in others, and where it looks.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "listeners.hpp"
#include "pictures.hpp"
#include "transparency_report.hpp"
#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/io/checkpoint.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/rl/alphabet.hpp"
#include "wordgaze/rl/evaluator.hpp"

namespace {

using namespace wordgaze;

struct Arguments {
  std::string checkpoint, env, json, pictures;
  std::vector<int> rooms, objects;
  int episodes = 1000;
  std::uint64_t seed = 1'000'000;
  int threads = 0;
  bool greedy = false, sample = false, transparency = false;
  apps::Listeners::Options listeners;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Evaluates a trained agent: a table on the terminal, one row a setting and policy.\n"
      "Without --greedy and --sample both policies are measured."};
  app.set_version_flag("--version", WORDGAZE_VERSION);
  app.add_option("--checkpoint", a.checkpoint, "file that train has written")->required();
  app.add_option("--rooms", a.rooms, "room sizes N in place of the trained one, as 8,10,12")
      ->delimiter(',');
  app.add_option("--objects", a.objects, "numbers of objects K, as 4,8,12")->delimiter(',');
  app.add_option("--env", a.env, "environment in place of the one trained in");
  app.add_option("--episodes", a.episodes, "a setting")->check(CLI::Range(1, 100'000'000));
  app.add_option("--seed", a.seed, "episode k runs in the world of seed SEED + k");
  app.add_option("--threads", a.threads, "0: all processors")->check(CLI::Range(0, 256));
  app.add_flag("--greedy", a.greedy, "the likeliest action");
  app.add_flag("--sample", a.sample, "actions drawn from the policy");
  app.add_flag("--transparency", a.transparency,
               "measure where the agent looks and whether that decides (docs/metrics.md)");
  app.add_option("--json", a.json, "file for the table as JSON");
  app.add_option("--pictures", a.pictures, "folder for pictures of the attention (PNG)");
  app.add_option("--lcm-log", a.listeners.log, "LCM log of every step");
  app.add_option("--lcm-url", a.listeners.url, "publish the same live, as udpm://");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return a;
}

/// The id with other room sizes and numbers of objects; only Wordgaze's ids have them.
std::vector<std::string> settings(const Arguments& a, const std::string& trained) {
  const std::string base = a.env.empty() ? trained : a.env;
  if (a.rooms.empty() && a.objects.empty()) return {base};
  static const std::regex pattern(R"((Wordgaze-\w+)-N(\d+)-K(\d+)(-auto)?-v0)");
  std::smatch match;
  require(std::regex_match(base, match, pattern),
          "--rooms and --objects change the N and K of a Wordgaze-*-N*-K*-v0 id; '{}' has none; "
          "give --env",
          base);
  const auto or_own = [&](const std::vector<int>& wanted, int group) {
    return wanted.empty() ? std::vector{std::stoi(match[group])} : wanted;
  };
  std::vector<std::string> ids;
  for (const int room : or_own(a.rooms, 2)) {
    for (const int objects : or_own(a.objects, 3)) {
      ids.push_back(fmt::format("{}-N{}-K{}{}-v0", match[1].str(), room, objects, match[4].str()));
    }
  }
  return ids;
}

nlohmann::ordered_json to_json(const rl::Breakdown::Counts& counts) {
  nlohmann::ordered_json json;
  for (const auto& [key, count] : counts) {
    json[key] = {{"episodes", count.episodes}, {"success_rate", count.success_rate()}};
  }
  return json;
}

nlohmann::ordered_json record(const std::string& id, const rl::Evaluation& evaluation,
                              const rl::EvaluationResult& r, const rl::Interval& ci) {
  const auto& level = evaluation.level;
  return {{"env", id},
          {"room", level.room_size},
          {"objects", babyai::objects(level).value_or(0)},
          {"policy", evaluation.greedy ? "greedy" : "sampled"},
          {"episodes", r.episodes},
          {"seed", evaluation.seed},
          {"success_rate", r.success_rate()},
          {"success_ci95", {ci.low, ci.high}},
          {"mean_reward", r.mean_reward()},
          {"mean_steps", r.mean_steps()},
          {"done_wrong", r.done_wrong},
          {"truncated", r.truncated},
          {"hit", r.hits.seen > 0 ? nlohmann::ordered_json(r.hits.rate()) : nullptr},
          {"by_verb", to_json(r.breakdown.by_verb)},
          {"by_join", to_json(r.breakdown.by_join)},
          {"by_clauses", to_json(r.breakdown.by_clauses)},
          {"by_object", to_json(r.breakdown.by_object)}};
}

/// Where missions join clauses: success by the words that do.
void print_joins(const rl::Breakdown& breakdown) {
  if (breakdown.by_join.size() < 2) return;
  fmt::print("  success by join:");
  for (const auto& [join, count] : breakdown.by_join) {
    fmt::print("  {} {:.1f}% of {}", join, 100 * count.success_rate(), count.episodes);
  }
  fmt::print("\n");
}

int run(Arguments a) {
  const rl::TrainConfig config = io::load_config(a.checkpoint);
  const auto params = io::load_params(a.checkpoint, config.model);
  if (!a.greedy && !a.sample) a.greedy = a.sample = true;

  // Every id is looked up before the first episode: a typing error should not cost an hour.
  std::vector<rl::Evaluation> evaluations;
  for (const auto& id : settings(a, config.env)) {
    const auto level = babyai::find_level(id);
    for (const bool greedy : {false, true}) {
      if (greedy ? !a.greedy : !a.sample) continue;
      evaluations.push_back(
          {.level = level, .episodes = a.episodes, .seed = a.seed, .greedy = greedy});
    }
  }
  a.listeners.run_id = "eval";
  a.listeners.checkpoint = a.checkpoint;
  apps::Listeners listeners(a.listeners);
  Team team(a.threads > 0 ? a.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));

  nlohmann::ordered_json report{{"checkpoint", a.checkpoint},
                                {"settings", nlohmann::ordered_json::array()}};
  fmt::print("{:<30} {:>7} {:>8} {:>8}  {:<15} {:>7} {:>6} {:>6} {:>6} {:>6}\n", "environment",
             "policy", "episodes", "success", "95 % interval", "reward", "steps", "wrong",
             "time up", "hit");
  for (const auto& evaluation : evaluations) {
    const rl::Agent agent{config.model, rl::alphabet_of(evaluation.level)};
    std::optional<explain::Transparency> transparency;
    if (a.transparency) transparency.emplace(agent, params, config.ppo.mask_truth);
    const auto r = rl::evaluate(
        agent, params, evaluation, team,
        {.observer = listeners.observer(), .witness = transparency ? &*transparency : nullptr});
    const auto ci = rl::wilson_interval(r.successes, r.episodes);
    fmt::print(
        "{:<30} {:>7} {:>8} {:>7.1f}%  [{:>5.1f}, {:>5.1f}] {:>8.3f} {:>6.1f} {:>6} {:>7} "
        "{:>6.3f}\n",
        evaluation.level.id, evaluation.greedy ? "greedy" : "sampled", r.episodes,
        100 * r.success_rate(), 100 * ci.low, 100 * ci.high, r.mean_reward(), r.mean_steps(),
        r.done_wrong, r.truncated, r.hits.rate());
    print_joins(r.breakdown);
    report["settings"].push_back(record(evaluation.level.id, evaluation, r, ci));
    if (transparency) {
      apps::print(*transparency);
      report["settings"].back()["transparency"] = apps::to_json(*transparency);
    }
    std::fflush(stdout);
  }
  if (!a.json.empty()) io::write_file(a.json, report.dump(2) + "\n");
  if (!a.pictures.empty()) {
    const auto& level = evaluations.front().level;
    const rl::Agent agent{config.model, rl::alphabet_of(level)};
    const int count = apps::draw_pictures(agent, params, level, a.seed, a.pictures);
    fmt::print("{} pictures in {}\n", count, a.pictures);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "eval: {}\n", error.what());
    return 1;
  }
}
