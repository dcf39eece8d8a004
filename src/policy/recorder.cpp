#include "wordgaze/policy/recorder.hpp"

namespace wordgaze::policy {

bool Recorder::begin(std::int64_t episode, int lane, std::uint64_t seed,
                     const env::Environment& env) {
  if (!observer_->wants_episode(episode)) return false;
  episode_ = episode;
  lane_ = lane;
  observer_->on_begin({.episode = episode,
                       .lane = lane,
                       .env_id = env.id(),
                       .seed = seed,
                       .sentence = env.sentence(),
                       .mission = env.mission(),
                       .max_steps = env.max_steps(),
                       .steps = env.step_count()});
  return true;
}

void Recorder::decide(const Policy& policy, int lane, const env::Environment& env,
                      const Observation& observation, const Decision& decision) {
  const auto logits = policy.logits(lane);
  logits_.assign(logits.begin(), logits.end());
  policy.attention(lane, attention_);
  image_ = observation.image;
  record_.episode = episode_;
  record_.lane = lane_;
  record_.step = env.step_count();
  record_.direction = env.direction();
  record_.agent_x = env.world().agent.x;
  record_.agent_y = env.world().agent.y;
  record_.action = static_cast<int>(decision.action);
  record_.value = decision.value;
  record_.entropy = decision.entropy;
  record_.logits = logits_;
  record_.word_weights = attention_.weights;
  record_.word_mask = attention_.mask;
  record_.word_attention = attention_.maps;
  record_.attention_map = attention_.gaze;
}

void Recorder::step(const env::Transition& transition) {
  record_.reward = static_cast<float>(transition.reward);
  record_.terminated = transition.terminated;
  record_.truncated = transition.truncated;
  observer_->on_step(record_);
}

}  // namespace wordgaze::policy
