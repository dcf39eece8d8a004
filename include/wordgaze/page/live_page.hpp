#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::page {

/// The page of episodes while they happen: a server on a thread of its own, to which any number of
/// browsers may turn (at most 8 at a time listen). What happened lately is kept for those who come
/// late. Reading is all that can be done there, unless commands are wanted (play).
///
/// Only this machine can reach it unless another address is given; then anybody can who reaches
/// that address, for there is no password.
class LivePage final : public policy::Observer, public evaluation::DecisionObserver {
 public:
  struct Options {
    std::string title;
    std::string address = "127.0.0.1";
    int port = 0;           ///< 0: any that is free
    int every = 1;          ///< of the episodes, each `every`-th
    bool commands = false;  ///< may a reader send commands?
  };
  /// Throws std::runtime_error when it cannot listen there.
  explicit LivePage(Options options);
  ~LivePage() override;

  std::string url() const;

  /// The next command that a reader has sent, a JSON object as text; nothing when none has come
  /// within that time.
  std::optional<std::string> next_command(std::chrono::milliseconds wait);
  /// What the agent would do in a scene that has been told; its step is yet to come.
  void preview(const policy::StepRecord& step);
  /// A line that readers see.
  void note(std::string_view text);

  void on_run(std::string_view run_id) override;
  bool wants_episode(std::int64_t episode) override;
  bool wants_scenes() const override { return true; }
  void on_begin(const policy::EpisodeBegin& begin) override;
  void on_decision(const evaluation::DecisionContext& context) override;
  void on_scene(const policy::SceneRecord& scene) override;
  void on_step(const policy::StepRecord& step) override;
  void on_end(const policy::EpisodeEnd& end) override;
  void on_update(const policy::UpdateRecord& update) override;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace wordgaze::page
