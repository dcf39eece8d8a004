#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/evaluation/episode.hpp"
#include "wordgaze/evaluation/pointing.hpp"
#include "wordgaze/training/curriculum.hpp"
#include "wordgaze/training/rollout.hpp"

namespace wordgaze::training {

/// A share of the lanes with its environments, random streams and memory: what one worker collects
/// experience with. Each lane draws from streams of its own.
class LaneGroup {
 public:
  /// Lanes [first, first + policy->lanes()) of a run with this configuration.
  LaneGroup(std::unique_ptr<policy::Policy> policy, const TrainConfig& config,
            const babyai::LevelSpec& level, int first);

  /// Acts for a whole rollout, with the weights as they now are, and fills its columns of these
  /// lanes. With an observer, episodes of the first lane that it wants are reported; not those with
  /// a stretched view, which is not what a record would show. Throws std::runtime_error where a
  /// memory is no longer finite.
  void collect(const Curriculum& curriculum, Rollout& rollout, policy::Observer* observer);

  /// What ended, and where M looked, during the last collect().
  const std::vector<Outcome>& outcomes() const { return outcomes_; }
  const evaluation::Pointing& pointing() const { return pointing_; }

  /// One lane between two rollouts, for checkpoints.
  struct LaneState {
    std::vector<std::uint8_t> environment;
    core::Rng::State rng;
    bool helped = false;
    Stretch stretch;
    std::int64_t episode = 0;
    double episode_return = 0;
    policy::Policy::Memory memory;
  };
  LaneState state(int lane) const;
  /// Throws std::runtime_error for what does not fit this lane, and for a memory that is not
  /// finite.
  void restore(int lane, const LaneState& state);

 private:
  struct Lane {
    evaluation::Episode episode;
    core::Rng rng;
    bool helped = false;
    Stretch stretch{};
    std::int64_t number = 0;  // of the episode
    bool restored = false;    // and not yet stepped: perhaps in the middle of an episode
  };
  void start_episode(int lane, const Curriculum& curriculum);
  void observe(int lane);
  void step_lane(int lane, Index column, const policy::Decision& decision,
                 const Curriculum& curriculum, Rollout& rollout, policy::Observer* observer);
  void check_memories() const;
  void value_cuts(Rollout& rollout);

  const PpoConfig* ppo_;
  int first_;
  std::unique_ptr<policy::Policy> policy_;
  std::vector<Lane> lanes_;
  std::vector<Outcome> outcomes_;
  evaluation::Pointing pointing_;
  std::vector<Index> cuts_;  // columns whose episode time has cut off
};

}  // namespace wordgaze::training
