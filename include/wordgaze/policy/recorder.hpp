#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/policy/observer.hpp"
#include "wordgaze/policy/policy.hpp"

namespace wordgaze::policy {

/// Turns the decisions of one lane into the records of an observer. Holds the buffers that the
/// records point to.
class Recorder {
 public:
  explicit Recorder(Observer& observer) : observer_(&observer) {}
  Recorder(const Recorder&) = delete;  // its records point into itself
  Recorder& operator=(const Recorder&) = delete;

  /// Before the first step, or, where a run goes on in the middle of an episode, before the next.
  /// False if the observer does not want this episode; then nothing more is to be told of it.
  bool begin(std::int64_t episode, int lane, std::uint64_t seed, const env::Environment& env);

  /// Between the decision and the step: keeps what lane `lane` of the policy saw and decided.
  void decide(const Policy& policy, int lane, const env::Environment& env,
              const Observation& observation, const Decision& decision);
  /// After the step.
  void step(const env::Transition& transition);
  void end(const EpisodeEnd& end) { observer_->on_end(end); }

 private:
  void tell_scene(const env::Environment& env);

  Observer* observer_;
  std::int64_t episode_ = 0;
  int lane_ = 0;  // as reported
  AttentionRecord attention_;
  std::array<std::uint8_t, grid::kImageBytes> image_{};
  std::vector<float> logits_;
  std::vector<std::uint8_t> cells_;  // of the scene
  StepRecord record_{.image = image_};
};

}  // namespace wordgaze::policy
