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
  const auto length = env.sentence().length;
  const auto column = [&](const Matrix<float>& m, Index rows, std::vector<float>& to) {
    to.assign(m.col(lane).data(), m.col(lane).data() + rows);
  };
  column(cache.logits(), grid::kActions, logits_);
  weights_.clear();
  mask_.clear();
  attention_.clear();
  gaze_.clear();
  if (agent.config.attention) {
    const auto& a = cache.attention;
    column(a.weights, length, weights_);
    column(cache.alpha, length, mask_);
    const auto cells = actor.frames().cells.col(lane);
    for (Index i = 0; i < length; ++i) {
      for (Index c = 0; c < grid::kViewCells; ++c) {
        attention_.push_back(a.maps(cells(c), a.map(lane, i)));
      }
    }
    for (Index c = 0; c < grid::kViewCells; ++c) gaze_.push_back(a.gaze(cells(c), lane));
  }
  env.observe(image_);
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
  record_.word_weights = weights_;
  record_.word_mask = mask_;
  record_.word_attention = attention_;
  record_.attention_map = gaze_;
}

void Recorder::step(const env::Transition& transition) {
  record_.reward = static_cast<float>(transition.reward);
  record_.terminated = transition.terminated;
  record_.truncated = transition.truncated;
  observer_->on_step(record_);
}

}  // namespace wordgaze::rl
