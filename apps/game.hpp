#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/evaluation/episode.hpp"
#include "wordgaze/policy/trained_agent.hpp"

namespace wordgaze::apps {

/// An episode in which a person or the agent acts, one step at a time. Whoever acts, the agent
/// looks at each view and says what it would do; its memory goes on with what is done.
class Game {
 public:
  /// What is shown before each step: the scene, and what the agent would do.
  class Screen {
   public:
    virtual ~Screen() = default;
    virtual policy::Observer& preview() = 0;                  ///< on_scene, on_step
    virtual policy::Observer* episodes() { return nullptr; }  ///< what was done
    virtual evaluation::DecisionObserver* decisions() { return nullptr; }
  };

  /// The agent must know the cells of the level, and outlive this.
  Game(const babyai::LevelSpec& level, const policy::TrainedAgent& trained, std::uint64_t seed,
       Screen& screen)
      : policy_(trained), episode_(env::Environment(level)), seed_(seed), screen_(&screen) {
    begin();
  }
  Game(const Game&) = delete;
  Game& operator=(const Game&) = delete;

  const env::Environment& environment() const { return episode_.environment; }
  bool over() const { return over_; }
  const evaluation::Outcome& outcome() const { return episode_.outcome(); }
  /// What the agent would do now.
  grid::Action proposal() const { return decision_.as_action(); }

  /// Another world.
  void next_world() {
    ++seed_;
    begin();
  }
  /// The same world from its start, with another mission. Throws std::invalid_argument, and changes
  /// nothing, for one that is no mission or that nothing in this world fits.
  void tell(const std::string& mission) {
    const babyai::Instruction instruction = babyai::parse_mission(mission);
    env::Environment world = episode_.environment;
    world.reset(seed_);
    world.set_instruction(instruction);
    policy::Observation seen = policy::observe(world);
    policy_.begin(0);
    policy_.observe(0, seen);  // may refuse a mission that is too long for the agent
    begin(std::move(world));
  }
  /// One step: an action of a person's, or what the agent would do.
  void act(std::optional<grid::Action> action = {}) {
    if (over_) return;
    policy::Decision decision = decision_;
    if (action) decision.action = static_cast<std::size_t>(*action);
    over_ = episode_.step(policy_, 0, decision).ended();
    if (!over_) look();
  }

 private:
  void begin() {
    env::Environment world = episode_.environment;
    world.reset(seed_);
    begin(std::move(world));
  }
  void begin(env::Environment world) {
    episode_.environment = std::move(world);
    over_ = false;
    ++number_;
    episode_.begin(policy_, 0);
    if (auto* episodes = screen_->episodes()) {
      episode_.report(*episodes, {.number = number_, .lane = 0, .seed = seed_});
    }
    preview_ = std::make_unique<policy::Recorder>(screen_->preview());
    preview_->begin(number_, 0, seed_, episode_.environment);
    look();
  }
  void look() {
    episode_.observe();
    policy_.observe(0, episode_.observation);
    decision_ = policy_.decide(policy::Greedy{})[0];
    if (auto* decisions = screen_->decisions()) {
      decisions->on_decision({policy_, 0, episode_.environment, episode_.observation, decision_});
    }
    preview_->decide(policy_, 0, episode_.environment, episode_.observation, decision_);
    preview_->step({});
  }

  policy::NetworkPolicy<policy::Agent> policy_;
  evaluation::Episode episode_;
  std::uint64_t seed_;
  Screen* screen_;
  std::unique_ptr<policy::Recorder> preview_;
  policy::Decision decision_{};
  std::int64_t number_ = -1;
  bool over_ = false;
};

}  // namespace wordgaze::apps
