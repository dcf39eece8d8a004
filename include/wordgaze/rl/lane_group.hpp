#pragma once
#include <optional>

#include "wordgaze/rl/curriculum.hpp"
#include "wordgaze/rl/gaze_hits.hpp"
#include "wordgaze/rl/recorder.hpp"
#include "wordgaze/rl/rollout.hpp"

namespace wordgaze::rl {

/// A share of the lanes with its environments, random streams and memory: what one worker collects
/// experience with. Each lane draws from streams of its own.
class LaneGroup {
 public:
  /// Lanes [first, first + lanes) of a run with this seed.
  LaneGroup(const Agent& agent, const TrainConfig& config, const babyai::LevelSpec& level,
            int first, int lanes);

  /// Acts for a whole rollout and fills its columns of these lanes. With an observer, episodes of
  /// the first lane that it wants are reported.
  void collect(const Agent::Params& params, const Agent::Tables& tables,
               const Curriculum& curriculum, Rollout& rollout, Observer* observer);

  /// What ended, and where M looked, during the last collect().
  const std::vector<Outcome>& outcomes() const { return outcomes_; }
  const GazeHits& hits() const { return hits_; }
  const model::Missions& missions() const { return actor_.missions(); }

  /// One lane between two rollouts, for checkpoints.
  struct LaneState {
    std::vector<std::uint8_t> environment;
    core::Rng::State rng;
    bool begins = true, helped = false;
    Stretch stretch;
    std::int64_t episode = 0;
    double episode_return = 0;
    Vector<float> h, c;
  };
  LaneState state(int lane) const;
  void restore(int lane, const LaneState& state);

 private:
  struct Lane {
    env::Environment environment;
    core::Rng rng;
    double episode_return = 0;
    bool helped = false;
    Stretch stretch{};
    std::int64_t episode = 0;
  };
  /// A truncated episode: what its final value is to be asked for.
  struct Cut {
    Index column;
    int mission;
    Eigen::Matrix<std::uint8_t, grid::kViewCells, 1> cells;
    Vector<float> completion, h, c;
  };

  void start_episode(int lane, const Curriculum& curriculum);
  void look();
  void look(int lane);
  void step_lane(int lane, Index column, const Curriculum& curriculum, Rollout& rollout,
                 Observer* observer);
  void keep_cut(int lane, Index column);
  void value_cuts(const Agent::Params& params, const Agent::Tables& tables, Rollout& rollout);

  const Agent* agent_;
  const PpoConfig* ppo_;
  int first_;
  std::vector<Lane> lanes_;
  Actor actor_;
  std::vector<Outcome> outcomes_;
  GazeHits hits_;
  std::vector<Cut> cuts_;
  std::size_t cut_count_ = 0;  // of cuts_ in use; the rest keep their memory
  model::Frames<float> cut_frames_;
  Agent::Cache cut_cache_;
  std::optional<Recorder> recorder_;  // while an episode of the first lane is reported
};

}  // namespace wordgaze::rl
