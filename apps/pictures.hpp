#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "wordgaze/draw/decision_figure.hpp"
#include "wordgaze/evaluation/episode.hpp"
#include "wordgaze/evaluation/roles.hpp"
#include "wordgaze/policy/environment.hpp"

namespace wordgaze::apps {

/// Draws the decisions of an episode that tell most: the first, the one at which a target comes
/// into view, the one after a sub-task is completed, and the last.
class Painter final : public policy::Observer {
 public:
  Painter(std::filesystem::path folder, const env::Environment& environment)
      : folder_(std::move(folder)), environment_(&environment) {}

  int pictures() const { return pictures_; }

  /// Before each step: the world and the progress as they are, and whether a target is in view.
  void before_step(bool target_in_view) {
    before_ = environment_->world();
    comes_into_view_ = target_in_view && !seen_;
    seen_ = seen_ || target_in_view;
    progress_ = environment_->progress();
    const auto completion = progress_.completion();
    completed_ = !std::ranges::equal(completion, completion_);
    completion_.assign(completion.begin(), completion.end());
  }

  bool wants_episode(std::int64_t) override { return true; }
  void on_begin(const policy::EpisodeBegin& begin) override {
    episode_ = begin.episode;
    seen_ = false;
    const babyai::Progress progress = environment_->progress();
    const auto completion = progress.completion();
    completion_.assign(completion.begin(), completion.end());
  }
  void on_step(const policy::StepRecord& step) override {
    const bool last = step.terminated || step.truncated;
    if (step.step > 0 && !comes_into_view_ && !completed_ && !last) return;
    const auto image = draw::decision_figure(step, {.world = before_,
                                                    .sentence = environment_->sentence(),
                                                    .progress = progress_,
                                                    .env_id = environment_->id()});
    draw::write_png(folder_ / fmt::format("episode{:02}-step{:03}.png", episode_, step.step),
                    image);
    ++pictures_;
  }

 private:
  std::filesystem::path folder_;
  const env::Environment* environment_;
  grid::World before_;
  babyai::Progress progress_;
  std::int64_t episode_ = 0;
  std::vector<std::uint8_t> completion_;  // c_t of the last decision
  bool seen_ = false, comes_into_view_ = false, completed_ = false;
  int pictures_ = 0;
};

/// Pictures of a few episodes of a level into a folder; returns how many.
inline int draw_pictures(const model::Config& config, const policy::Agent::Params& params,
                         const babyai::LevelSpec& level, std::uint64_t seed,
                         const std::filesystem::path& folder) {
  constexpr int kEpisodes = 6;
  std::filesystem::create_directories(folder);
  const policy::Agent agent(config, policy::alphabet_of(level));
  const auto weights = agent.make_weights(params);
  policy::NetworkPolicy<policy::Agent> policy(agent, weights);
  evaluation::Episode episode{env::Environment(level)};
  Painter painter(folder, episode.environment);
  for (int number = 0; number < kEpisodes; ++number) {
    const std::uint64_t world = seed + static_cast<std::uint64_t>(number);
    episode.environment.reset(world);
    core::Rng rng(world);
    episode.begin(policy, 0);
    episode.report(painter, {.number = number, .lane = 0, .seed = world});
    for (bool ended = false; !ended;) {
      episode.observe();
      policy.observe(0, episode.observation);
      const auto decision = policy.decide(policy::Sampled{rng})[0];
      const auto roles =
          evaluation::roles_of(episode.observation.image, episode.environment.progress());
      painter.before_step(std::ranges::find(roles, evaluation::Role::target) != roles.end());
      ended = episode.step(policy, 0, decision).ended();
    }
  }
  return painter.pictures();
}

}  // namespace wordgaze::apps
