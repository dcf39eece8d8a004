#include "wordgaze/evaluation/episode.hpp"

namespace wordgaze::evaluation {

void Episode::begin(policy::Policy& policy, int lane) {
  outcome_ = {};
  recorder_.reset();
  policy.begin(lane);
}

void Episode::report(policy::Observer& observer, const Identity& identity) {
  identity_ = identity;
  recorder_ = std::make_unique<policy::Recorder>(observer);
  if (!recorder_->begin(identity.number, identity.lane, identity.seed, environment)) {
    recorder_.reset();
  }
}

Episode::Step Episode::step(const policy::Policy& policy, int lane,
                            const policy::Decision& decision) {
  if (recorder_) recorder_->decide(policy, lane, environment, observation, decision);
  const env::Transition transition = environment.step(decision.as_action());
  outcome_.episode_return += transition.reward;
  if (recorder_) recorder_->step(transition);
  const Step step{transition};
  if (!step.ended()) return step;
  outcome_.success = transition.terminated && transition.reward > 0;
  outcome_.truncated = !transition.terminated;
  outcome_.steps = environment.step_count();
  if (recorder_) {
    recorder_->end({.episode = identity_.number,
                    .lane = identity_.lane,
                    .steps = outcome_.steps,
                    .episode_return = outcome_.episode_return,
                    .success = outcome_.success,
                    .truncated = outcome_.truncated});
    recorder_.reset();
  }
  return step;
}

}  // namespace wordgaze::evaluation
