#pragma once
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "wordgaze/core/types.hpp"
#include "wordgaze/model/agent.hpp"
#include "wordgaze/policy/policy.hpp"
#include "wordgaze/policy/trained_agent.hpp"

namespace wordgaze::policy {

/// The policy of a network, for any type of Agent. Refers to the agent and to its weights, which
/// may change between two decisions (refresh()) and must outlive it.
template <class Agent>
class NetworkPolicy final : public Policy {
 public:
  using Weights = typename Agent::Weights;

  NetworkPolicy(const Agent& agent, const Weights& weights, int lanes = 1)
      : Policy(agent, lanes), agent_(&agent), weights_(&weights) {}
  explicit NetworkPolicy(const BasicTrainedAgent<Agent>& trained, int lanes = 1)
      : NetworkPolicy(trained.agent, trained.weights, lanes) {}

  bool gaze(int lane, std::span<float, grid::kViewCells> map) const override {
    if (!agent_->config.attention) return false;
    for (Index c = 0; c < grid::kViewCells; ++c) {
      map[static_cast<std::size_t>(c)] =
          decided_.attention.gaze(agent_->entry(frames().cells, c, lane), lane);
    }
    return true;
  }
  void attention(int lane, AttentionRecord& record) const override {
    record.clear();
    if (!agent_->config.attention) return;
    const auto& attention = decided_.attention;
    const auto entry = [&](Index cell) { return agent_->entry(frames().cells, cell, lane); };
    for (Index i = 0; i < sentence(lane).length; ++i) {
      record.weights.push_back(attention.weights(i, lane));
      record.mask.push_back(decided_.alpha(i, lane));
      for (Index c = 0; c < grid::kViewCells; ++c) {
        record.maps.push_back(attention.maps(entry(c), attention.map(lane, i)));
      }
    }
    for (Index c = 0; c < grid::kViewCells; ++c) {
      record.gaze.push_back(attention.gaze(entry(c), lane));
      record.filter.push_back(attention.scale(entry(c), lane));
    }
    record.nowhere = agent_->nowhere(decided_, lane);
  }

  Matrix<float> policies_for(int lane, const model::CellMatrix& views) override {
    return policies(lane, ask(lane, views));
  }
  Matrix<float> policies_for(int lane, std::span<const babyai::Sentence> sentences) override {
    model::Missions told;
    std::vector<int> mission_of;
    for (const babyai::Sentence& sentence : sentences) {
      model::Mission mission = missions()[frames().mission(lane)];  // with what is done of it
      static_cast<babyai::Sentence&>(mission) = sentence;
      mission_of.push_back(told.index_of(mission));
    }
    Matrix<float> features(text().rows(), told.size());
    encode_text(told, features);
    const auto count = static_cast<Index>(sentences.size());
    const model::CellMatrix views = frames().cells.col(lane).replicate(1, count);
    return policies(lane, ask(lane, views, mission_of, told, features));
  }

  Saliency saliency(int lane, std::size_t action) override {
    const model::CellMatrix view = frames().cells.col(lane);
    Question& q = ask(lane, view);
    const auto& p = weights_->params;
    // From the logit through the actor and one step of the memory, to the product W_x F.
    Matrix<float> dlogits = Matrix<float>::Zero(grid::kActions, 1);
    dlogits(static_cast<Index>(action), 0) = 1;
    model::Head<float>::backward(p.actor, q.cache.features, dlogits, q.cache.actor, q.grads.actor,
                                 q.cache.dfeatures);
    nn::Lstm<float>::backward(p.memory, q.frames.shape, q.frames.keep,
                              q.cache.dfeatures.topRows(agent_->config.memory_size), q.cache.memory,
                              q.grads.memory, q.cache.dproduct);
    const Index channels = agent_->config.channels;
    Saliency saliency{Vector<float>(grid::kViewCells), Vector<float>(grid::kViewCells)};
    for (Index c = 0; c < grid::kViewCells; ++c) {
      const auto weight = p.memory.input_weight.middleCols(c * channels, channels);
      const Vector<float> dfiltered = weight.transpose() * q.cache.dproduct.col(0);
      const float scale = agent_->scale(q.cache)(agent_->entry(view, c, 0), 0);
      const Vector<float> encoding =
          Agent::Vision::encoding(*agent_, weights_->tables.vision, q.cache.vision, view, c, 0);
      saliency.gradient(c) = dfiltered.norm();
      saliency.product(c) = std::abs(scale * encoding.dot(dfiltered));
    }
    return saliency;
  }

 private:
  /// Scratch of questions about a decision, made by the first one.
  struct Question {
    model::Frames<float> frames;
    typename Agent::Cache cache;
    model::Outputs<float> outputs;
    typename Agent::Params grads;  // what the backward passes leave beside what is asked for
  };

  void encode_text(const model::Missions& missions, Matrix<float>& text) override {
    agent_->encode_text(*weights_, missions, text_cache_, text);
  }
  void forward(Use use, const model::Frames<float>& frames,
               model::Outputs<float>& outputs) override {
    auto& cache = use == Use::decisions ? decided_ : kept_;
    agent_->forward(*weights_, frames, missions(), text(), cache, outputs);
  }
  void go_on(nn::Lstm<float>::State& memory) const override {
    memory.h = decided_.features.topRows(agent_->config.memory_size);
    memory.c = decided_.memory.cell;
  }

  /// The network again on other views of a lane.
  Question& ask(int lane, const model::CellMatrix& views) {
    const std::vector<int> mission_of(static_cast<std::size_t>(views.cols()),
                                      frames().mission(lane));
    return ask(lane, views, mission_of, missions(), text());
  }
  /// And on other missions.
  Question& ask(int lane, const model::CellMatrix& views, const std::vector<int>& mission_of,
                const model::Missions& told, const Matrix<float>& features) {
    if (question_ == nullptr) {
      question_ = std::make_unique<Question>();
      question_->grads = agent_->make_params();
    }
    Question& q = *question_;
    const nn::SequenceShape shape{1, views.cols()};
    if (q.frames.shape != shape) q.frames.resize(agent_->config, shape);
    q.frames.cells = views;
    q.frames.mission_of = mission_of;
    q.frames.completion.colwise() = frames().completion.col(lane);
    // The memory that the decision started from; empty where it began an episode.
    q.frames.start.h.colwise() = decided_.memory.h_prev.col(lane);
    q.frames.start.c.colwise() = decided_.memory.c_prev.col(lane);
    agent_->forward(*weights_, q.frames, told, features, q.cache, q.outputs);
    return q;
  }
  /// What was asked, as probabilities.
  Matrix<float> policies(int lane, const Question& q) const {
    const auto possible = logits(lane).size();
    Matrix<float> policies = q.outputs.logits;
    for (Index n = 0; n < policies.cols(); ++n) {
      const std::span<float> column(policies.col(n).data(), possible);
      nn::Categorical<float>::log_softmax(column, column);
    }
    policies = policies.array().exp();
    policies.bottomRows(grid::kActions - static_cast<Index>(possible)).setZero();
    return policies;
  }

  const Agent* agent_;
  const Weights* weights_;
  typename Agent::Cache decided_, kept_, text_cache_;
  std::unique_ptr<Question> question_;
};

}  // namespace wordgaze::policy

#if WORDGAZE_COMPILED  // set by wordgaze::policy, whose library holds it
extern template class wordgaze::policy::NetworkPolicy<wordgaze::policy::Agent>;
#endif
