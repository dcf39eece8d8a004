// play: act yourself, or watch the agent act, in the browser or in the terminal.
#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "chosen_level.hpp"
#include "command.hpp"
#include "game.hpp"
#include "output.hpp"
#include "terminal_screen.hpp"
#include "watch.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/training/checkpoint.hpp"

namespace {

using namespace wordgaze;

struct Arguments {
  std::string checkpoint, env, level;
  std::uint64_t seed = 1'000'000;
  double hz = 3;
  bool agent = false, terminal = false;
  apps::Watch place{.wanted = true};
};

/// The game on a live page.
class BrowserScreen final : public apps::Game::Screen, private policy::Observer {
 public:
  explicit BrowserScreen(page::LivePage& live) : live_(&live) {}
  policy::Observer& preview() override { return *this; }
  policy::Observer* episodes() override { return live_; }
  evaluation::DecisionObserver* decisions() override { return live_; }

 private:
  bool wants_episode(std::int64_t) override { return true; }
  bool wants_scenes() const override { return true; }
  void on_scene(const policy::SceneRecord& scene) override { live_->on_scene(scene); }
  void on_step(const policy::StepRecord& step) override { live_->preview(step); }

  page::LivePage* live_;
};

/// What a reader of the page wants.
void obey(const std::string& text, apps::Game& game, page::LivePage& live, bool& agent) {
  const auto command = nlohmann::json::parse(text, nullptr, false);
  if (!command.is_object()) return;
  const auto given = [&](const char* key) {
    const auto found = command.find(key);
    return found != command.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (const std::string name = given("action"); !name.empty()) {
    agent = false;
    const auto action = std::ranges::find(grid::kActionPhrases, name);
    if (action != grid::kActionPhrases.end()) {
      game.act(static_cast<grid::Action>(action - grid::kActionPhrases.begin()));
    }
  } else if (const std::string who = given("who"); !who.empty()) {
    agent = who == "agent";
    if (who == "step") game.act();
  } else if (const std::string mission = given("mission"); !mission.empty()) {
    try {
      game.tell(mission);
      live.note("");
    } catch (const std::invalid_argument& error) {
      live.note(error.what());
    }
  } else if (command.contains("next")) {
    game.next_world();
  }
}

void play_in_browser(const Arguments& a, const babyai::LevelSpec& level,
                     const policy::TrainedAgent& trained) {
  const auto live = a.place.open({.title = "Play in " + level.id, .commands = true});
  live->on_run("play");
  BrowserScreen screen(*live);
  apps::Game game(level, trained, a.seed, screen);
  const io::StopSignals signals("\nplay: good bye\n");
  using Clock = std::chrono::steady_clock;
  const auto pause = std::chrono::milliseconds(static_cast<int>(1000 / a.hz));
  bool agent = a.agent;
  auto due = Clock::now() + pause;
  while (io::StopSignals::received() == 0) {
    const auto wait = std::chrono::duration_cast<std::chrono::milliseconds>(due - Clock::now());
    const auto command = live->next_command(
        std::clamp(wait, std::chrono::milliseconds(1), std::chrono::milliseconds(200)));
    if (command) obey(*command, game, *live, agent);
    if (Clock::now() < due) continue;
    due = Clock::now() + pause;
    if (agent && !game.over()) game.act();
  }
}

void play_in_terminal(const Arguments& a, const babyai::LevelSpec& level,
                      const policy::TrainedAgent& trained) {
  apps::say(
      "arrows: turn and go forward; p pick up, d drop, t toggle, e done; a: the agent's step, "
      "g: the agent to the end;\nm: another mission, n: another world, q: quit\n");
  apps::TerminalScreen screen;
  apps::Game game(level, trained, a.seed, screen);
  apps::Keyboard keyboard;
  using grid::Action;
  for (char key = keyboard.key(); key != 0 && key != 'q'; key = keyboard.key()) {
    switch (key) {
      case 'A':
        game.act(Action::forward);
        break;
      case 'C':
        game.act(Action::right);
        break;
      case 'D':
        game.act(Action::left);
        break;
      case 'p':
        game.act(Action::pickup);
        break;
      case 'd':
        game.act(Action::drop);
        break;
      case 't':
        game.act(Action::toggle);
        break;
      case 'e':
        game.act(Action::done);
        break;
      case 'a':
        game.act();
        break;
      case 'g':
        while (!game.over()) game.act();
        break;
      case 'n':
        game.next_world();
        break;
      case 'm':
        apps::say("mission: ");
        try {
          game.tell(keyboard.line());
        } catch (const std::invalid_argument& error) {
          apps::say("{}\n", error.what());
        }
        break;
      default:
        break;
    }
    if (game.over()) {
      const auto& outcome = game.outcome();
      apps::say("{} after {} steps; n: another world, m: another mission, q: quit\n",
                outcome.success     ? "done"
                : outcome.truncated ? "out of time"
                                    : "failed",
                outcome.steps);
    }
  }
}

int run(const Arguments& a) {
  const auto config = training::load_config(a.checkpoint);
  const auto level = apps::chosen_level(a.level, a.env, config.env, config.level);
  const auto trained = policy::TrainedAgent::load(a.checkpoint, policy::alphabet_of(level));
  if (a.terminal) {
    play_in_terminal(a, level, trained);
  } else {
    play_in_browser(a, level, trained);
  }
  return 0;
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::play_command() {
  return {"play",
          "Act yourself, or let the agent act, and see where it looks; type a mission and it does "
          "it.\nA page in the browser, or with --terminal letters in the terminal.",
          [](CLI::App& app) {
            const auto a = std::make_shared<Arguments>();
            app.add_option("--checkpoint", a->checkpoint, "an agent: file that train has written")
                ->required();
            app.add_option("--env", a->env, "environment in place of the one trained in");
            app.add_option("--level", a->level, "the same, of a file: docs/own-level.md");
            app.add_option("--seed", a->seed, "of the first world")
                ->check(whole_number<std::uint64_t>(0))
                ->capture_default_str();
            app.add_flag("--agent", a->agent, "the agent acts from the start");
            app.add_option("--hz", a->hz, "steps a second of the agent")
                ->check(CLI::Range(0.1, 100.0))
                ->capture_default_str();
            app.add_flag("--terminal", a->terminal, "in the terminal");
            Watch::add_place(app, a->place);
            return [a] { return run(*a); };
          }};
}
