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
  record_.filter = attention_.filter;
  record_.nowhere = attention_.nowhere;
  if (observer_->wants_scenes()) tell_scene(env);
}

void Recorder::tell_scene(const env::Environment& env) {
  const grid::World& world = env.world();
  const babyai::Sentence& sentence = env.sentence();
  const babyai::Progress progress = env.progress();
  const auto targets = babyai::target_cells(world, progress);
  grid::write_cells(world, cells_);
  observer_->on_scene(
      {.episode = episode_,
       .lane = lane_,
       .step = record_.step,
       .width = world.grid.width(),
       .height = world.grid.height(),
       .cells = cells_,
       .agent_x = world.agent.x,
       .agent_y = world.agent.y,
       .direction = env.direction(),
       .carried = grid::code_of(world.object(world.carried)),
       .completion = progress.completion(),
       .enabled = progress.enabled(),
       .sub_task_of =
           std::span(sentence.sub_task_of).first(static_cast<std::size_t>(sentence.length)),
       .targets = targets});
}

void Recorder::step(const env::Transition& transition) {
  record_.reward = static_cast<float>(transition.reward);
  record_.terminated = transition.terminated;
  record_.truncated = transition.truncated;
  observer_->on_step(record_);
}

}  // namespace wordgaze::policy
