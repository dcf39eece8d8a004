#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "wordgaze/babyai/level_text.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/env/policy.hpp"
#include "wordgaze/policy/network_policy.hpp"

/// The one bridge from the simulator to agents.
namespace wordgaze::policy {

/// What an agent is told in an environment.
inline void observe(const env::Environment& environment, Observation& observation) {
  environment.observe(observation.image);
  observation.completion = {};
  const babyai::Progress progress = environment.progress();
  std::ranges::copy(progress.completion(), observation.completion.begin());
  observation.sentence = environment.sentence();
  observation.actions = environment.num_actions();
}
inline Observation observe(const env::Environment& environment) {
  Observation observation;
  observe(environment, observation);
  return observation;
}

/// The smallest alphabet that holds every cell a level can show.
inline model::CellAlphabet alphabet_of(const babyai::LevelSpec& level) {
  const bool one_room = level.rows == 1 && level.columns == 1 &&
                        level.rule == babyai::Rule::instruction && !babyai::has_more(level);
  return one_room ? model::CellAlphabet::one_room() : model::CellAlphabet::everything();
}

/// An agent as a policy of environments, to be recorded or compared as the bot is.
class EnvironmentPolicy {
 public:
  EnvironmentPolicy(std::shared_ptr<const TrainedAgent> trained, std::uint64_t seed, bool greedy)
      : trained_(std::move(trained)),
        policy_(std::make_unique<NetworkPolicy<Agent>>(*trained_)),
        rng_(seed),
        greedy_(greedy) {}

  grid::Action operator()(const env::Environment& environment) {
    if (environment.step_count() == 0) policy_->begin(0);
    observe(environment, observation_);
    policy_->observe(0, observation_);
    const auto decisions = greedy_ ? policy_->decide(Greedy{}) : policy_->decide(Sampled{rng_});
    return decisions[0].as_action();
  }

  /// For the seeds of many streams, each with random draws of its own.
  static env::PolicyMaker maker(std::shared_ptr<const TrainedAgent> trained, bool greedy) {
    return [trained = std::move(trained), greedy](std::string_view, std::uint64_t seed,
                                                  std::uint64_t policy_seed) -> env::Policy {
      return
          [shared = std::make_shared<EnvironmentPolicy>(trained, seed ^ policy_seed << 32, greedy)](
              const env::Environment& environment) { return (*shared)(environment); };
    };
  }

 private:
  std::shared_ptr<const TrainedAgent> trained_;
  std::unique_ptr<NetworkPolicy<Agent>> policy_;
  core::Rng rng_;
  bool greedy_;
  Observation observation_;
};

}  // namespace wordgaze::policy
