#pragma once
#include <array>
#include <string>
#include <utility>

#include "support.hpp"
#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/model/agent.hpp"

/// Compiled once for all tests, in agent_test.cpp.
extern template struct wordgaze::model::Agent<double>;

/// A small agent with random weights, frames and missions.
namespace wordgaze::test {

inline babyai::Sentence sentence(const std::string& text) {
  babyai::Sentence s;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    s.append(babyai::word_id(text.substr(begin, end - begin)).value(), 0);
    begin = end + 1;
  }
  return s;
}

inline model::Config small_config() {
  model::Config c;
  c.channels = 3;
  c.word_size = 4;
  c.key_size = 3;
  c.memory_size = 5;
  c.text_size = 4;
  c.head_size = 4;
  c.task_size = 6;
  c.task_words = 14;
  c.sub_tasks = 2;
  c.encoder_leak = 0.1;
  c.word_choice_start = 0.5;
  c.word_choice = 3;
  c.sharpness_start = 1;
  c.sharpness = 3;
  c.score_cost_start = c.score_cost = 0;
  return c;
}

template <std::floating_point S>
struct AgentFixture {
  model::Agent<S> agent;
  typename model::Agent<S>::Weights weights;
  typename model::Agent<S>::Params& params = weights.params;
  typename model::Agent<S>::Cache cache;
  model::Outputs<S> outputs;
  model::Frames<S> frames;
  model::Missions missions;

  AgentFixture(const AgentFixture&) = delete;  // params refers to weights
  AgentFixture& operator=(const AgentFixture&) = delete;
  explicit AgentFixture(const model::Config& config, nn::SequenceShape shape = {3, 2})
      : agent{config, model::CellAlphabet::one_room()} {
    weights = agent.make_weights();
    randomize_parameters(params);
    // Away from the ReLU's corner.
    for (auto* bias : {&params.vision.cells.bias, &params.vision.patches.first.bias})
      bias->array() += S(1);
    frames.resize(config, shape);
    const std::array sentences{sentence("go to the red ball"),
                               sentence("pick up the blue key , then go to the grey box"),
                               sentence("open the door")};
    if (params.attention.focus.size() > 0) params.attention.focus(0) = S(0.7);
    for (Index n = 0; n < shape.columns(); ++n) {
      for (Index c = 0; c < grid::kViewCells; ++c) {
        // Mostly a few kinds, as in a real view, so that counts above one occur.
        const auto draw = static_cast<int>(generator()() % 100);
        frames.cells(c, n) =
            static_cast<std::uint8_t>(draw < 80 ? draw % 3 : draw % agent.alphabet.size());
      }
      for (Index i = 0; i < config.sub_tasks; ++i) {
        frames.completion(i, n) = static_cast<S>((n + i) % 2);
      }
      model::Mission mission{sentences[static_cast<std::size_t>(n) % sentences.size()], {}};
      for (std::size_t i = 0; model::scans(config) && i < 2; ++i) {
        mission.done[i] = frames.completion(static_cast<Index>(i), n) > 0;
      }
      frames.mission_of[static_cast<std::size_t>(n)] = missions.index_of(mission);
    }
    frames.keep(0, frames.shape.column(1, 1)) = 0;
    randomize(frames.start.h, 0.5);
    randomize(frames.start.c, 0.5);
  }

  void forward() {
    agent.refresh(weights);
    forward_frames();
  }
  void forward_frames() {
    text.resize(model::mission_features(agent.config), missions.size());
    agent.encode_text(weights, missions, cache, text);
    agent.forward(weights, frames, missions, text, cache, outputs);
  }
  /// The gradient of the weights from that of the outputs, by a team of `workers` that all see the
  /// same frames and are asked for an equal part each.
  typename model::Agent<S>::Params gradient(const model::Outputs<S>& asked, int workers = 1) {
    auto grads = agent.make_gradients(workers);
    model::Outputs<S> part = asked;
    for (auto* m : {&part.logits, &part.values, &part.mask}) *m /= static_cast<S>(workers);
    for (auto& own : grads) {
      nn::set_zero(own);
      forward_frames();
      agent.backward(weights, frames, missions, outputs, part, cache, own);
    }
    Team team(workers);
    agent.reduce(weights, grads, team);
    return std::move(grads.front().params);
  }
  /// Random numbers in the place of a loss's gradient.
  model::Outputs<S> random_gradient() const {
    const Index n = frames.shape.columns();
    model::Outputs<S> asked;
    asked.resize(agent.config, n);
    randomize(asked.logits);
    randomize(asked.values);
    randomize(asked.mask, 0.3);
    // A scan has no logits behind the end of a mission.
    for (Index i = 0; model::scans(agent.config) && i < n; ++i) {
      asked.mask.col(i).tail(asked.mask.rows() - missions[frames.mission(i)].length).setZero();
    }
    return asked;
  }

  Matrix<S> text;
};

}  // namespace wordgaze::test
