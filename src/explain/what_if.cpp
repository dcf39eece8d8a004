#include "wordgaze/explain/what_if.hpp"

#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::explain {

using rl::Agent;

WhatIf::WhatIf(const Agent& agent, const Agent::Params& params)
    : agent_(&agent),
      params_(&params),
      tables_(agent.make_tables()),
      grads_(nn::zeros_like(params)) {
  agent.update_all_tables(params, tables_);
}

void WhatIf::forward(const rl::Decision& decision, const model::CellMatrix& views) {
  const auto& actor = decision.actor;
  const auto lane = static_cast<Index>(decision.lane);
  const nn::SequenceShape shape{1, views.cols()};
  if (frames_.shape != shape) frames_.resize(agent_->config, shape);
  frames_.cells = views;
  frames_.mission_of.assign(static_cast<std::size_t>(views.cols()),
                            actor.frames().mission_of[static_cast<std::size_t>(lane)]);
  frames_.completion.colwise() = actor.frames().completion.col(lane);
  // The memory that the decision started from; empty where it began an episode.
  frames_.start.h.colwise() = actor.cache().memory.h_prev.col(lane);
  frames_.start.c.colwise() = actor.cache().memory.c_prev.col(lane);
  agent_->forward(*params_, tables_, frames_, actor.missions(), actor.text(), cache_);
}

Matrix<float> WhatIf::policies(const rl::Decision& decision, const model::CellMatrix& views) {
  forward(decision, views);
  Matrix<float> policies = cache_.logits();
  for (Index n = 0; n < policies.cols(); ++n) {
    const std::span<float> column(policies.col(n).data(), grid::kActions);
    nn::Categorical<float>::log_softmax(column, column);
  }
  return policies.array().exp();
}

WhatIf::Saliency WhatIf::saliency(const rl::Decision& decision) {
  const model::CellMatrix view = decision.actor.frames().cells.col(decision.lane);
  forward(decision, view);
  // From the logit through the actor and one step of the memory, to the product W_x F.
  Matrix<float> dlogits = Matrix<float>::Zero(grid::kActions, 1);
  dlogits(static_cast<Index>(decision.action), 0) = 1;
  cache_.dfeatures.setZero();
  model::Head<float>::backward(params_->actor, cache_.features, dlogits, cache_.actor, grads_.actor,
                               cache_.dfeatures);
  nn::Lstm<float>::backward(params_->memory, frames_.shape, frames_.keep,
                            cache_.dfeatures.topRows(agent_->config.memory_size), cache_.memory,
                            grads_.memory);
  const Vector<float> dproduct = cache_.memory.dgates.col(0);
  const Index channels = agent_->config.channels;
  Saliency saliency{Vector<float>(grid::kViewCells), Vector<float>(grid::kViewCells)};
  for (Index c = 0; c < grid::kViewCells; ++c) {
    const auto weight = params_->memory.input_weight.middleCols(c * channels, channels);
    const Vector<float> dfiltered = weight.transpose() * dproduct;
    const float scale = agent_->scale(cache_)(agent_->kind(view, c, 0), 0);
    saliency.gradient(c) = dfiltered.norm();
    saliency.product(c) =
        std::abs(scale * agent_->encoding(tables_, cache_, view, c, 0).dot(dfiltered));
  }
  return saliency;
}

}  // namespace wordgaze::explain
