#pragma once
#include <cstdint>
#include <memory>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/policy/recorder.hpp"

namespace wordgaze::evaluation {

/// How an episode ended.
struct Outcome {
  bool success = false, truncated = false;
  int steps = 0;
  double episode_return = 0;
};

/// An environment with a policy's lane at work in it: what training and evaluation do alike, step
/// by step.
///
///     episode.begin(policy, lane);          // the environment has been reset
///     episode.observe();                    // and, if need be, change what was seen
///     policy.observe(lane, episode.observation);
///     const auto decisions = policy.decide(sampler);
///     if (episode.step(policy, lane, decisions[lane]).ended()) episode.outcome();
class Episode {
 public:
  explicit Episode(const env::Environment& blank) : environment(blank) {}

  env::Environment environment;
  policy::Observation observation;

  /// An episode that has just been reset.
  void begin(policy::Policy& policy, int lane);

  struct Identity {
    std::int64_t number = 0;
    int lane = 0;            ///< as reported
    std::uint64_t seed = 0;  ///< 0: the stream goes on
  };
  /// Before the first step, or, where a run goes on in the middle of an episode, before the next:
  /// the episode is reported, if the observer wants it.
  void report(policy::Observer& observer, const Identity& identity);

  void observe() { policy::observe(environment, observation); }

  struct Step {
    env::Transition transition;
    bool ended() const { return transition.terminated || transition.truncated; }
  };
  /// Does what was decided, and reports it.
  Step step(const policy::Policy& policy, int lane, const policy::Decision& decision);

  /// After the last step.
  const Outcome& outcome() const { return outcome_; }

  /// Of the running episode so far, for checkpoints.
  double episode_return() const { return outcome_.episode_return; }
  void set_episode_return(double sum) { outcome_.episode_return = sum; }

 private:
  Identity identity_;
  Outcome outcome_;
  std::unique_ptr<policy::Recorder> recorder_;  // while it is reported
};

}  // namespace wordgaze::evaluation
