#pragma once
#include <vector>

#include "wordgaze/rl/observer.hpp"
#include "wordgaze/rl/sight.hpp"

namespace wordgaze::rl {

/// Turns the decisions of one lane of an actor into the records of an observer. Holds the buffers
/// that the records point to.
class Recorder {
 public:
  explicit Recorder(Observer& observer) : observer_(&observer) {}
  Recorder(const Recorder&) = delete;  // its records point into itself
  Recorder& operator=(const Recorder&) = delete;

  /// False if the observer does not want this episode; then nothing more is to be told of it.
  bool begin(std::int64_t episode, int lane, std::uint64_t seed, const env::Environment& env);

  /// Between decide() and the step: keeps what was seen and decided.
  void decide(const Agent& agent, const Actor& actor, int lane, const env::Environment& env,
              int action, float entropy);
  /// After the step.
  void step(const env::Transition& transition);
  void end(const EpisodeEnd& end) { observer_->on_end(end); }

 private:
  Observer* observer_;
  std::int64_t episode_ = 0;
  Sight sight_;
  std::vector<float> logits_;
  StepRecord record_{.image = sight_.image};
};

}  // namespace wordgaze::rl
