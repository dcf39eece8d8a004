#include "wordgaze/rl/actor.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wordgaze::rl {

Actor::Actor(const Agent& agent, int lanes) : agent_(&agent) {
  require(lanes > 0, "Actor: needs at least one lane, got {}", lanes);
  frames_.resize(agent.config, {1, lanes});
}

int Actor::mission(const babyai::Sentence& sentence) {
  const int index = missions_.index_of(sentence);
  if (index >= encoded_ + fresh_.size()) fresh_.index_of(sentence);
  return index;
}

void Actor::refresh() {
  const model::Missions old = std::move(missions_);
  missions_ = {};
  fresh_.clear();
  encoded_ = 0;
  if (old.size() == 0) return;
  for (auto& m : frames_.mission_of) m = mission(old[m]);
}

void Actor::begin(int lane, const babyai::Sentence& sentence) {
  const auto& config = agent_->config;
  const auto& of = sentence.sub_task_of;
  const int sub_tasks =
      1 + *std::max_element(of.begin(), of.begin() + std::max(1, sentence.length));
  if ((config.task_attention || config.completion_input) && sub_tasks > config.clauses) {
    throw std::invalid_argument(fmt::format(
        "mission '{}' has {} sub-tasks, the completion vector of the agent {}; train with a larger "
        "model.clauses",
        babyai::text(sentence), sub_tasks, config.clauses));
  }
  frames_.mission_of[static_cast<std::size_t>(lane)] = mission(sentence);
  frames_.keep(0, lane) = 0;
}

void Actor::observe(int lane, const env::Environment& environment) {
  std::array<std::uint8_t, grid::kImageBytes> image;
  environment.observe(image);
  agent_->alphabet.encode(image, std::span<std::uint8_t, grid::kViewCells>(
                                     frames_.cells.col(lane).data(), grid::kViewCells));
  auto completion = frames_.completion.col(lane);
  completion.setZero();
  const babyai::Progress progress = environment.progress();
  const auto c = progress.completion();
  for (std::size_t i = 0; i < c.size() && static_cast<Index>(i) < completion.size(); ++i) {
    completion(static_cast<Index>(i)) = c[i];
  }
}

void Actor::decide(const Agent::Params& params, const Agent::Tables& tables) {
  if (fresh_.size() > 0) {
    agent_->encode_missions(params, tables, fresh_, text_cache_);
    const auto text = Agent::text(text_cache_);
    if (text_.cols() < missions_.size()) {
      text_.conservativeResize(text.rows(), std::max<Index>(2 * text_.cols(), missions_.size()));
    }
    text_.middleCols(encoded_, fresh_.size()) = text.leftCols(fresh_.size());
    encoded_ += fresh_.size();
    fresh_.clear();
  }
  agent_->forward(params, tables, frames_, missions_, text_, cache_);
}

void Actor::advance() {
  frames_.start.h = cache_.memory.h;
  frames_.start.c = cache_.memory.cell;
  frames_.keep.setOnes();
}

}  // namespace wordgaze::rl
