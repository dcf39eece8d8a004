#pragma once
#include "wordgaze/env/environment.hpp"
#include "wordgaze/model/agent.hpp"

/// Compiled once, in src/model/agent.cpp.
extern template struct wordgaze::model::Agent<float>;

namespace wordgaze::rl {

using Agent = model::Agent<float>;

/// The agent in use: one decision a call for each of a number of lanes, with the memory in between.
/// Training, evaluation and a robot act through it.
class Actor {
 public:
  Actor(const Agent& agent, int lanes);

  int lanes() const { return static_cast<int>(frames_.shape.batch); }

  /// Forgets the text features: after the weights changed. Lanes keep their memory and missions.
  void refresh();

  /// A new episode in a lane: empty memory, another mission. Throws std::invalid_argument for one
  /// of more sub-tasks than the completion vector has entries, if the agent reads it.
  void begin(int lane, const babyai::Sentence& sentence);

  /// What the lane sees now, and its completion vector.
  void observe(int lane, const env::Environment& environment);

  /// Logits and values of all lanes for what they see, into cache().
  void decide(const Agent::Params& params, const Agent::Tables& tables);

  /// Takes the memory of the last decision along.
  void advance();

  const Agent::Cache& cache() const { return cache_; }
  model::Frames<float>& frames() { return frames_; }
  const model::Frames<float>& frames() const { return frames_; }
  const model::Missions& missions() const { return missions_; }
  const babyai::Sentence& sentence(int lane) const {
    return missions_[frames_.mission_of[static_cast<std::size_t>(lane)]];
  }
  const Matrix<float>& text() const { return text_; }

 private:
  int mission(const babyai::Sentence& sentence);

  const Agent* agent_;
  model::Frames<float> frames_;  // one step
  Agent::Cache cache_;
  model::Missions missions_;  // all that were met since refresh()
  Matrix<float> text_;        // [G, missions or more] of those that are encoded
  int encoded_ = 0;
  model::Missions fresh_;  // scratch: those still to be encoded
  Agent::Cache text_cache_;
};

}  // namespace wordgaze::rl
