#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/grid/position.hpp"

/// What training and evaluation tell whoever listens: LCM, pictures, logs. The records are views
/// into the caller's buffers and live for one call.
namespace wordgaze::policy {

struct EpisodeBegin {
  std::int64_t episode = 0;  ///< unique in one run, increasing
  int lane = 0;              ///< which of the parallel environments
  std::string_view env_id;
  std::uint64_t seed = 0;  ///< seed of this reset; 0 when the stream was continued
  const babyai::Sentence& sentence;
  std::string_view mission;
  int max_steps = 0;
  int steps = 0;  ///< done before; above 0 when a run goes on in the middle of an episode
};

/// How things stand when an agent decides, what it cannot see included. Told before the step's
/// record.
struct SceneRecord {
  std::int64_t episode = 0;
  int lane = 0;
  int step = 0;
  int width = 0, height = 0;              ///< of the world, in cells
  std::span<const std::uint8_t> cells{};  ///< [width][height][3] of grid::write_cells
  int agent_x = -1, agent_y = -1;
  int direction = 0;
  std::array<std::uint8_t, 3> carried{1, 0, 0};  ///< type, color, door state; empty: nothing
  std::span<const std::uint8_t> completion{};    ///< c_t, one 0/1 a sub-task
  std::span<const std::uint8_t> enabled{};       ///< one 0/1 a sub-task: its turn has come
  std::span<const std::int8_t> sub_task_of{};    ///< one a word of the mission; -1: joins clauses
  std::span<const grid::Position> targets{};     ///< babyai::target_cells
};

/// One decision: what was seen, where the agent looked, what it did and what came of it.
struct StepRecord {
  std::int64_t episode = 0;
  int lane = 0;
  int step = 0;  ///< 0-based within the episode
  const std::array<std::uint8_t, grid::kImageBytes>& image;
  int direction = 0;
  int agent_x = -1, agent_y = -1;
  int action = 0;
  float value = 0, entropy = 0, reward = 0;
  bool terminated = false, truncated = false;
  std::span<const float> logits{};        ///< one per action
  std::span<const float> word_weights{};  ///< w, one per word of the mission; sums to 1
  std::span<const float> word_mask{};     ///< alpha in [0,1], one per word; ones without the module
  std::span<const float> word_attention{};  ///< A, 49 per word, row by row; each row sums to 1
  std::span<const float>
      attention_map{};              ///< M = sum_i alpha_i w_i A_i, 49; empty for the baseline
  std::span<const float> filter{};  ///< s(M), 49: what the view is multiplied with
  float nowhere = 0;                ///< what M has on nowhere: not in view
};

struct EpisodeEnd {
  std::int64_t episode = 0;
  int lane = 0;
  int steps = 0;
  double episode_return = 0;
  bool success = false, truncated = false;
};

/// Named scalars of one update: an open set, the columns of metrics.csv.
struct Scalar {
  std::string_view name;
  double value;
};
struct UpdateRecord {
  std::int64_t update = 0, frames = 0;
  std::span<const Scalar> scalars;
};

/// Listener; every call is optional. Called from one thread, in order.
class Observer {
 public:
  virtual ~Observer() = default;
  /// What follows belongs to this run. An evaluation has one for each setting and policy.
  virtual void on_run(std::string_view /*run_id*/) {}
  /// Asked once an episode: are the steps of this one wanted? The records cost time to fill.
  virtual bool wants_episode(std::int64_t /*episode*/) { return false; }
  /// Asked with each step of a wanted episode: is the scene wanted, too?
  virtual bool wants_scenes() const { return false; }
  virtual void on_begin(const EpisodeBegin&) {}
  virtual void on_scene(const SceneRecord&) {}
  virtual void on_step(const StepRecord&) {}
  virtual void on_end(const EpisodeEnd&) {}
  virtual void on_update(const UpdateRecord&) {}
};

}  // namespace wordgaze::policy
