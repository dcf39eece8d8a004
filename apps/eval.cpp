// eval: how well a trained agent does, in the room it knows and in others, and where it looks.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "chosen_level.hpp"
#include "command.hpp"
#include "listeners.hpp"
#include "output.hpp"
#include "pace.hpp"
#include "pictures.hpp"
#include "transparency_report.hpp"
#include "watch.hpp"
#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/bot/policy.hpp"
#include "wordgaze/evaluation/evaluator.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/output_check.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/page/episode_page.hpp"
#include "wordgaze/training/checkpoint.hpp"

namespace {

using namespace wordgaze;
using evaluation::Evaluation;

struct Arguments {
  std::string checkpoint, policy, env, level, json, pictures, page;
  std::vector<int> rooms, objects;
  int episodes = 1000, page_episodes = 100;
  std::uint64_t seed = 1'000'000;
  int threads = 0;
  bool greedy = false, sample = false, transparency = false, live = false;
  std::optional<double> hz;
  apps::Watch watch;
  apps::Listeners::Options listeners;
};

void add_options(CLI::App& app, Arguments& a) {
  auto* who = app.add_option_group("who acts");
  who->add_option("--checkpoint", a.checkpoint, "an agent: file that train has written");
  who->add_option("--policy", a.policy,
                  "bot: BabyAI's expert, random, or mixed; wants --env or "
                  "--level")
      ->check(CLI::IsMember({"bot", "random", "mixed"}));
  who->require_option(1);
  app.add_option("--rooms", a.rooms, "room sizes N in place of the level's own, as 8,10,12")
      ->delimiter(',')
      ->check(apps::whole_number(1));
  app.add_option("--objects", a.objects, "numbers of objects K, as 4,8,12")
      ->delimiter(',')
      ->check(apps::whole_number(0));
  auto* env = app.add_option("--env", a.env, "environment in place of the one trained in");
  app.add_option("--level", a.level, "TOML file of a level of one's own, in place of --env")
      ->type_name("FILE")
      ->excludes(env);
  app.add_option("--episodes", a.episodes, "a setting")->check(apps::whole_number(1, 100'000'000));
  app.add_option("--seed", a.seed, "episode k runs in the world of seed SEED + k")
      ->check(apps::whole_number<std::uint64_t>(0));
  app.add_option("--threads", a.threads, "0: all processors")->check(apps::whole_number(0, 256));
  app.add_flag("--greedy", a.greedy, "the likeliest action");
  app.add_flag("--sample", a.sample, "actions drawn from the policy");
  app.add_flag("--transparency", a.transparency,
               "measure where the agent looks and whether that decides (docs/metrics.md)");
  app.add_option("--json", a.json, "file for the table as JSON");
  app.add_option("--pictures", a.pictures,
                 "folder for pictures (PNG) of the attention in the first 6 episodes of the first "
                 "setting, for each policy; pictures of an earlier evaluation there are removed");
  app.add_option(
      "--page", a.page,
      "file for a page (HTML) that shows the first episodes of the first setting step by "
      "step, for each policy: open it in a browser");
  app.add_option("--page-episodes", a.page_episodes, "so many of them")
      ->check(apps::whole_number(1, 100'000));
  apps::Watch::add_options(app, a.watch);
  apps::Listeners::add_options(app, a.listeners, "LCM log of every step");
  app.add_flag(
      "--live", a.live,
      "one episode at a time, at a pace that can be watched on --lcm-url; --watch does so too");
  app.add_option("--hz", a.hz, "steps a second of --live and --watch (5)")
      ->check(CLI::Range(0.01, 1000.0));
}

/// The level with other room sizes and numbers of objects.
std::vector<babyai::LevelSpec> settings(const Arguments& a, const babyai::LevelSpec& level) {
  std::vector<babyai::LevelSpec> levels{level};
  const auto vary = [&](const std::vector<int>& wanted, auto&& change) {
    if (wanted.empty()) return;
    std::vector<babyai::LevelSpec> varied;
    for (const auto& each : levels) {
      for (const int value : wanted) varied.push_back(change(each, value));
    }
    levels = std::move(varied);
  };
  // Objects last, for what fits depends on the room.
  vary(a.rooms, babyai::with_room);
  vary(a.objects, babyai::with_objects);
  return levels;
}

nlohmann::ordered_json to_json(const evaluation::Breakdown::Counts& counts) {
  nlohmann::ordered_json json;
  for (const auto& [key, count] : counts) {
    json[key] = {{"episodes", count.episodes}, {"success_rate", count.success_rate()}};
  }
  return json;
}

nlohmann::ordered_json record(const Evaluation& evaluation, const char* policy,
                              const evaluation::EvaluationResult& r) {
  const auto& level = evaluation.level;
  const auto ci = evaluation::wilson_interval(r.successes, r.episodes);
  const auto objects = babyai::objects(level);
  const auto& hit = r.pointing.target;
  return {{"env", level.id},
          {"room", level.room_size},
          {"objects", objects ? nlohmann::ordered_json(*objects) : nullptr},
          {"policy", policy},
          {"episodes", r.episodes},
          {"seed", evaluation.seed},
          {"success_rate", r.success_rate()},
          {"success_ci95", {ci.low, ci.high}},
          {"mean_reward", r.mean_reward()},
          {"mean_steps", r.mean_steps()},
          {"done_wrong", r.done_wrong},
          {"truncated", r.truncated},
          {"hit", hit.count > 0 ? nlohmann::ordered_json(hit.value()) : nullptr},
          {"by_verb", to_json(r.breakdown.by_verb)},
          {"by_join", to_json(r.breakdown.by_join)},
          {"by_clauses", to_json(r.breakdown.by_clauses)},
          {"by_object", to_json(r.breakdown.by_object)}};
}

void print_head() {
  apps::say("{:<30} {:>7} {:>8} {:>8}  {:<15} {:>7} {:>6} {:>6} {:>6} {:>6}\n", "environment",
            "policy", "episodes", "success", "95 % interval", "reward", "steps", "wrong", "time up",
            "hit");
}

void print_row(const Evaluation& evaluation, const char* policy,
               const evaluation::EvaluationResult& r) {
  const auto ci = evaluation::wilson_interval(r.successes, r.episodes);
  apps::say(
      "{:<30} {:>7} {:>8} {:>7.1f}%  [{:>5.1f}, {:>5.1f}] {:>8.3f} {:>6.1f} {:>6} {:>7} "
      "{:>6.3f}\n",
      evaluation.level.id, policy, r.episodes, 100 * r.success_rate(), 100 * ci.low, 100 * ci.high,
      r.mean_reward(), r.mean_steps(), r.done_wrong, r.truncated, r.pointing.target.value());
}

/// Where missions join clauses: success by the words that do.
void print_joins(const evaluation::Breakdown& breakdown) {
  if (breakdown.by_join.size() < 2) return;
  apps::say("  success by join:");
  for (const auto& [join, count] : breakdown.by_join) {
    apps::say("  {} {:.1f}% of {}", join, 100 * count.success_rate(), count.episodes);
  }
  apps::say("\n");
}

/// A team of as many workers as were asked for.
int threads(const Arguments& a) {
  return a.threads > 0 ? a.threads
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string page_title(const std::filesystem::path& checkpoint, const babyai::LevelSpec& level) {
  return fmt::format("{} in {}", checkpoint.stem().string(), level.id);
}

/// A trained agent in each setting, with each policy that is wanted.
void evaluate_agent(Arguments a, nlohmann::ordered_json& report) {
  const training::TrainConfig config = training::load_config(a.checkpoint);
  const auto trained = policy::TrainedAgent::load(a.checkpoint);
  if (!a.greedy && !a.sample) a.greedy = a.sample = true;

  // Every level is made before the first episode: a typing error should not cost an hour.
  const auto levels = settings(a, apps::chosen_level(a.level, a.env, config.env, config.level));
  a.listeners.checkpoint = a.checkpoint;
  apps::Listeners listeners(a.listeners);
  if (!a.pictures.empty()) apps::remove_old_pictures(a.pictures);
  std::optional<page::EpisodePage> page;
  if (!a.page.empty()) page.emplace(page_title(a.checkpoint, levels.front()), a.page_episodes);
  const auto live = a.watch.open({.title = page_title(a.checkpoint, levels.front())});
  int evaluations = 0, pictures = 0;
  Team team(threads(a));
  apps::Pace pace(a.hz.value_or(5));
  for (const auto& level : levels) {
    const policy::Agent agent(config.model, policy::alphabet_of(level));
    const auto weights = agent.make_weights(trained.weights.params);
    for (const bool greedy : {false, true}) {
      if (greedy ? !a.greedy : !a.sample) continue;
      Evaluation evaluation{.level = level,
                            .episodes = a.episodes,
                            .seed = a.seed,
                            .greedy = greedy,
                            .first = std::int64_t{evaluations} * a.episodes,
                            .between_steps = io::StopSignals::check};
      if (a.live || a.watch.wanted) {
        evaluation.lanes = 1;
        evaluation.between_steps = [&] { pace.wait(); };
      }
      const char* policy = greedy ? "greedy" : "sampled";
      listeners.on_run(fmt::format("eval-{}-{}", ++evaluations, policy));
      std::optional<evaluation::Transparency> transparency;
      if (a.transparency) transparency.emplace(config.model, config.ppo.mask_truth);
      policy::Observers episodes;
      evaluation::DecisionObservers decisions;
      episodes.add(listeners.observer());
      decisions.add(transparency ? &*transparency : nullptr);
      const bool shown = &level == &levels.front();
      std::optional<apps::Painter> painter;
      if (!a.pictures.empty() && shown) {
        painter.emplace(a.pictures, policy, evaluation.first);
        episodes.add(&*painter);
        decisions.add(&*painter);
      }
      if (page && shown) {
        page->on_run(policy);
        episodes.add(&*page);
        decisions.add(&*page);
      }
      if (live) live->on_run(policy);
      episodes.add(live.get());
      decisions.add(live.get());
      const auto r =
          evaluation::evaluate(evaluation::policy_factory(agent, weights), evaluation, team,
                               {.episodes = episodes.or_null(), .decisions = decisions.or_null()});
      if (painter) pictures += painter->pictures();
      print_row(evaluation, policy, r);
      print_joins(r.breakdown);
      report["settings"].push_back(record(evaluation, policy, r));
      if (transparency) {
        apps::print(*transparency);
        report["settings"].back()["transparency"] = apps::to_json(*transparency);
      }
    }
  }
  if (!a.pictures.empty()) apps::say("{} pictures in {}\n", pictures, a.pictures);
  if (page) {
    page->write(a.page);
    apps::say("{} episodes to look at in {}\n", page->episodes(), a.page);
  }
  if (live) {
    live->note("The evaluation is over.");
    apps::note("the page stays until Ctrl-C\n");
    while (io::StopSignals::received() == 0) live->next_command(std::chrono::milliseconds(200));
  }
}

/// The bot or the random policy, for comparison.
void evaluate_policy(const Arguments& a, nlohmann::ordered_json& report) {
  require(!a.env.empty() || !a.level.empty(),
          "--policy {} wants --env ID or --level FILE: in which environment?", a.policy);
  const bool attention = a.transparency || !a.pictures.empty() || !a.page.empty() ||
                         a.watch.wanted || !a.listeners.log.empty() || !a.listeners.url.empty() ||
                         a.greedy || a.sample;
  require(
      !attention,
      "--policy {}: --greedy, --sample, --transparency, --pictures, --page, --watch, --lcm-log and "
      "--lcm-url are for agents, which have a policy and attention to show; leave them out",
      a.policy);
  Team team(threads(a));
  for (const auto& level : settings(a, apps::chosen_level(a.level, a.env))) {
    const Evaluation evaluation{.level = level,
                                .episodes = a.episodes,
                                .seed = a.seed,
                                .between_steps = io::StopSignals::check};
    const auto r = evaluation::evaluate(bot::policy_maker(a.policy), evaluation, team);
    print_row(evaluation, a.policy.c_str(), r);
    print_joins(r.breakdown);
    report["settings"].push_back(record(evaluation, a.policy.c_str(), r));
  }
}

int run(const Arguments& a) {
  require(!a.live || !a.listeners.url.empty(),
          "--live is for somebody who watches: say where, with --lcm-url");
  require(!a.hz || a.live || a.watch.wanted,
          "--hz is the pace of --live and of --watch; give one of them");
  require(std::isfinite(a.hz.value_or(5)), "--hz {}: expected steps a second, 0.01 to 1000",
          a.hz.value_or(5));
  if (!a.pictures.empty()) std::filesystem::create_directories(a.pictures);  // others may lie there
  io::check_outputs(std::array{io::NamedPath{"--json", a.json}, io::NamedPath{"--page", a.page},
                               io::NamedPath{"--lcm-log", a.listeners.log}},
                    std::array{io::NamedPath{"--checkpoint", a.checkpoint}});
  const io::StopSignals signals("\neval: stopping; again to stop at once\n");
  nlohmann::ordered_json report{{"checkpoint", a.checkpoint},
                                {"settings", nlohmann::ordered_json::array()}};
  print_head();
  if (a.policy.empty()) {
    evaluate_agent(a, report);
  } else {
    evaluate_policy(a, report);
  }
  if (!a.json.empty()) {
    // A name that is not UTF-8 is no reason to lose the numbers.
    constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
    io::write_file(a.json, report.dump(2, ' ', false, kReplace) + "\n");
  }
  return 0;
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::eval_command() {
  return {"eval",
          "Evaluates a trained agent: a table on the terminal, one row a setting and policy.\n"
          "Without --greedy and --sample both policies are measured.",
          [](CLI::App& app) {
            const auto arguments = std::make_shared<Arguments>();
            add_options(app, *arguments);
            return [arguments] { return run(*arguments); };
          }};
}
