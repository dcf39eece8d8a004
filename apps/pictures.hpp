#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "wordgaze/draw/decision_figure.hpp"
#include "wordgaze/nn/categorical.hpp"
#include "wordgaze/rl/gaze_hits.hpp"
#include "wordgaze/rl/recorder.hpp"

namespace wordgaze::apps {

/// Draws the decisions of an episode that tell most: the first, the one at which a target comes
/// into view, the one after a sub-task is completed, and the last.
class Painter final : public rl::Observer {
 public:
  Painter(std::filesystem::path folder, const env::Environment& environment)
      : folder_(std::move(folder)), environment_(&environment) {}

  int pictures() const { return pictures_; }

  /// Before each step: the world as it is, and whether a target is in view.
  void look(bool target_in_view) {
    before_ = environment_->world();
    comes_into_view_ = target_in_view && !seen_;
    seen_ = seen_ || target_in_view;
    const babyai::Progress progress = environment_->progress();
    const auto completion = progress.completion();
    completed_ = !std::ranges::equal(completion, completion_);
    completion_.assign(completion.begin(), completion.end());
  }

  bool wants_episode(std::int64_t) override { return true; }
  void on_begin(const rl::EpisodeBegin& begin) override {
    episode_ = begin.episode;
    seen_ = false;
    const babyai::Progress progress = environment_->progress();
    const auto completion = progress.completion();
    completion_.assign(completion.begin(), completion.end());
  }
  void on_step(const rl::StepRecord& step) override {
    const bool last = step.terminated || step.truncated;
    if (step.step > 0 && !comes_into_view_ && !completed_ && !last) return;
    const auto image = draw::decision_figure(
        step,
        {.world = before_, .sentence = environment_->sentence(), .env_id = environment_->id()});
    draw::write_png(folder_ / fmt::format("episode{:02}-step{:03}.png", episode_, step.step),
                    image);
    ++pictures_;
  }

 private:
  std::filesystem::path folder_;
  const env::Environment* environment_;
  grid::World before_;
  std::int64_t episode_ = 0;
  std::vector<std::uint8_t> completion_;  // c_t of the last decision
  bool seen_ = false, comes_into_view_ = false, completed_ = false;
  int pictures_ = 0;
};

/// Pictures of a few episodes of a level into a folder; returns how many.
inline int draw_pictures(const rl::Agent& agent, const rl::Agent::Params& params,
                         const babyai::LevelSpec& level, std::uint64_t seed,
                         const std::filesystem::path& folder) {
  constexpr int kEpisodes = 6;
  using Choice = nn::Categorical<float>;
  std::filesystem::create_directories(folder);
  auto tables = agent.make_tables();
  agent.update_all_tables(params, tables);
  env::Environment environment(level);
  rl::Actor actor(agent, 1);
  Painter painter(folder, environment);
  rl::Recorder recorder(painter);
  for (int episode = 0; episode < kEpisodes; ++episode) {
    const std::uint64_t world = seed + static_cast<std::uint64_t>(episode);
    environment.reset(world);
    core::Rng rng(world);
    actor.begin(0, environment.sentence());
    recorder.begin(episode, 0, world, environment);
    for (env::Transition now; !now.terminated && !now.truncated;) {
      actor.observe(0, environment);
      actor.decide(params, tables);
      actor.advance();
      std::array<float, grid::kActions> log_p;
      Choice::log_softmax({actor.cache().logits().data(), grid::kActions}, log_p);
      const auto action = Choice::sample(log_p, static_cast<float>(rng.uniform()));
      rl::GazeHits hits;
      hits.add(agent, actor, 0, environment);
      painter.look(hits.seen > 0);
      recorder.decide(agent, actor, 0, environment, static_cast<int>(action),
                      Choice::entropy(log_p));
      now = environment.step(static_cast<grid::Action>(action));
      recorder.step(now);
    }
  }
  return painter.pictures();
}

}  // namespace wordgaze::apps
