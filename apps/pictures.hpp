#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/draw/decision_figure.hpp"
#include "wordgaze/evaluation/evaluator.hpp"
#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::apps {

/// Removes the pictures of an earlier evaluation from a folder, which would pass for some of this
/// one, and nothing else.
inline void remove_old_pictures(const std::filesystem::path& folder) {
  static const std::regex ours(R"(((sampled|greedy)-)?episode\d{2,}-step\d{3,}\.png)");
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const bool is_picture = std::regex_match(entry.path().filename().string(), ours);
    if (is_picture && entry.is_regular_file()) old.push_back(entry.path());
  }
  for (const auto& picture : old) std::filesystem::remove(picture);
}

/// Draws, of the first episodes of an evaluation, the decisions that tell most: the first, the one
/// at which a target comes into view, the one after a sub-task is completed, and the last.
class Painter final : public policy::Observer, public evaluation::DecisionObserver {
 public:
  static constexpr int kEpisodes = 6;

  /// Pictures of the episodes from number `first` on go to `folder`, their names begin with
  /// `policy`.
  Painter(std::filesystem::path folder, std::string policy, std::int64_t first)
      : folder_(std::move(folder)), policy_(std::move(policy)), first_(first) {}

  int pictures() const { return pictures_; }

  bool wants_episode(std::int64_t episode) override { return draws(episode); }
  void on_begin(const policy::EpisodeBegin& begin) override {
    if (draws(begin.episode)) scenes_[begin.lane] = {};
  }
  void on_decision(const evaluation::DecisionContext& context) override {
    const auto drawn = scenes_.find(context.lane);
    if (drawn != scenes_.end()) drawn->second.look(context);
  }
  void on_step(const policy::StepRecord& step) override {
    if (draws(step.episode)) draw(step, scenes_.at(step.lane));
  }
  void on_end(const policy::EpisodeEnd& end) override {
    if (draws(end.episode)) scenes_.erase(end.lane);
  }

 private:
  /// What a record does not say: how things stood before a step.
  struct Scene {
    grid::World world{};
    babyai::Sentence sentence{};
    babyai::Progress progress{};
    std::string env_id{};
    std::vector<std::uint8_t> completion{};  // c_t
    bool begun = false, seen = false, comes_into_view = false, completed = false;

    void look(const evaluation::DecisionContext& context) {
      const env::Environment& environment = context.environment;
      world = environment.world();
      sentence = environment.sentence();
      progress = environment.progress();
      env_id = environment.id();
      const auto roles = evaluation::roles_of(context.observation.image, progress);
      const bool in_view = std::ranges::find(roles, evaluation::Role::target) != roles.end();
      comes_into_view = in_view && !seen;
      seen = seen || in_view;
      const auto now = progress.completion();
      completed = std::exchange(begun, true) && !std::ranges::equal(now, completion);
      completion.assign(now.begin(), now.end());
    }
  };

  bool draws(std::int64_t episode) const {
    return episode >= first_ && episode < first_ + kEpisodes;
  }
  void draw(const policy::StepRecord& step, const Scene& scene) {
    const bool last = step.terminated || step.truncated;
    if (step.step > 0 && !scene.comes_into_view && !scene.completed && !last) return;
    const auto image = draw::decision_figure(step, {.world = scene.world,
                                                    .sentence = scene.sentence,
                                                    .progress = scene.progress,
                                                    .env_id = scene.env_id});
    const auto name =
        fmt::format("{}-episode{:02}-step{:03}.png", policy_, step.episode - first_, step.step);
    draw::write_png(folder_ / name, image);
    ++pictures_;
  }

  std::filesystem::path folder_;
  std::string policy_;
  std::int64_t first_;
  std::map<int, Scene> scenes_;  // by lane, of the episodes that are drawn
  int pictures_ = 0;
};

}  // namespace wordgaze::apps
