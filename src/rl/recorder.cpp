#include "wordgaze/rl/recorder.hpp"

namespace wordgaze::rl {

bool Recorder::begin(std::int64_t episode, int lane, std::uint64_t seed,
                     const env::Environment& env) {
  if (!observer_->wants_episode(episode)) return false;
  episode_ = episode;
  observer_->on_begin({.episode = episode,
                       .lane = lane,
                       .env_id = env.id(),
                       .seed = seed,
                       .sentence = env.sentence(),
                       .mission = env.mission(),
                       .max_steps = env.max_steps()});
  return true;
}

void Recorder::decide(const Agent& agent, const Actor& actor, int lane, const env::Environment& env,
                      int action, float entropy) {
  const auto& cache = actor.cache();
  const auto logits = cache.logits().col(lane);
  logits_.assign(logits.data(), logits.data() + grid::kActions);
  look(agent, actor, lane, env, sight_);
  record_.episode = episode_;
  record_.lane = lane;
  record_.step = env.step_count();
  record_.direction = env.direction();
  record_.agent_x = env.world().agent.x;
  record_.agent_y = env.world().agent.y;
  record_.action = action;
  record_.value = cache.values()(0, lane);
  record_.entropy = entropy;
  record_.logits = logits_;
  record_.word_weights = sight_.weights;
  record_.word_mask = sight_.mask;
  record_.word_attention = sight_.maps;
  record_.attention_map = sight_.gaze;
}

void Recorder::step(const env::Transition& transition) {
  record_.reward = static_cast<float>(transition.reward);
  record_.terminated = transition.terminated;
  record_.truncated = transition.truncated;
  observer_->on_step(record_);
}

}  // namespace wordgaze::rl
