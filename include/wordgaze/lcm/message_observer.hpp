#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/lcm/origin.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::lcm_io {

/// Turns what it hears into encoded messages; where they go is up to the derived class.
class MessageObserver : public policy::Observer {
 public:
  bool wants_episode(std::int64_t episode) final { return episode % every_ == 0; }
  void on_run(std::string_view run_id) final { origin_.run_id = run_id; }
  bool wants_scenes() const final { return true; }
  void on_begin(const policy::EpisodeBegin& record) final;
  void on_scene(const policy::SceneRecord& record) final;
  void on_step(const policy::StepRecord& record) final;
  void on_end(const policy::EpisodeEnd& record) final;
  void on_update(const policy::UpdateRecord& record) final;

 protected:
  /// Of the episodes, only every `every`-th is heard. Throws std::invalid_argument when it is not
  /// positive.
  MessageObserver(Origin origin, int every);

  /// An episode whose begin need not be sent again when a run goes on in the middle of it.
  void is_open(std::int64_t episode) { open_episode_ = episode; }
  const std::string& run_id() const { return origin_.run_id; }

  /// `utime` is the time of sending in microseconds since 1970.
  virtual void send(std::string_view channel, std::vector<std::uint8_t> bytes,
                    std::int64_t utime) = 0;

 private:
  Origin origin_;
  int every_;
  std::optional<std::int64_t> open_episode_;
};

}  // namespace wordgaze::lcm_io
