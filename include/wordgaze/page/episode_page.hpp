#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::page {

/// A page to look at episodes with: one HTML file that needs nothing else, no network either. Shows
/// the world, the view, where each word and all of them look, the policy, and, of an agent at
/// work, what it would have done without a cell or a word. What is in the file: docs/formats.md.
///
/// As an Observer it hears of the episodes, from an evaluation or from a log; as a DecisionObserver
/// it asks the network the questions. It may hear more than it wants: it takes the first
/// `episodes` of each run.
class EpisodePage final : public policy::Observer, public evaluation::DecisionObserver {
 public:
  explicit EpisodePage(std::string title, int episodes = 100);
  ~EpisodePage() override;

  void on_run(std::string_view run_id) override;
  bool wants_episode(std::int64_t episode) override;
  bool wants_scenes() const override { return true; }
  void on_begin(const policy::EpisodeBegin& begin) override;
  void on_decision(const evaluation::DecisionContext& context) override;
  void on_scene(const policy::SceneRecord& scene) override;
  void on_step(const policy::StepRecord& step) override;
  void on_end(const policy::EpisodeEnd& end) override;

  int episodes() const;  ///< that have begun
  /// The whole page; episodes that have not ended are shown as far as they went.
  std::string html() const;
  /// All or nothing; throws std::runtime_error that names the file and the cause.
  void write(const std::filesystem::path& path) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace wordgaze::page
