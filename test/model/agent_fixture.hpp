#pragma once
#include <string>

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
  c.clauses = 2;
  c.encoder_leak = 0.1;
  return c;
}

template <std::floating_point S>
struct AgentFixture {
  model::Agent<S> agent;
  typename model::Agent<S>::Params params;
  typename model::Agent<S>::Tables tables;
  typename model::Agent<S>::Cache cache;
  model::Frames<S> frames;
  model::Missions missions;

  explicit AgentFixture(const model::Config& config, nn::SequenceShape shape = {3, 2})
      : agent{config, model::CellAlphabet::one_room()} {
    params = agent.make_params();
    randomize_parameters(params);
    // Away from the ReLU's corner.
    for (auto* bias : {&params.visual.bias, &params.patches.first.bias}) bias->array() += S(1);
    tables = agent.make_tables();
    frames.resize(config, shape);
    missions.index_of(sentence("go to the red ball"));
    missions.index_of(sentence("pick up the blue key , then go to the grey box"));
    missions.index_of(sentence("open the door"));
    for (Index n = 0; n < shape.columns(); ++n) {
      frames.mission_of[static_cast<std::size_t>(n)] = static_cast<int>(n) % missions.size();
      for (Index c = 0; c < grid::kViewCells; ++c) {
        // Mostly a few kinds, as in a real view, so that counts above one occur.
        const auto draw = static_cast<int>(generator()() % 100);
        frames.cells(c, n) =
            static_cast<std::uint8_t>(draw < 80 ? draw % 3 : draw % agent.alphabet.size());
      }
      for (Index i = 0; i < config.clauses; ++i) {
        frames.completion(i, n) = static_cast<S>((n + i) % 2);
      }
    }
    frames.keep(0, frames.shape.column(1, 1)) = 0;
    randomize(frames.start.h, 0.5);
    randomize(frames.start.c, 0.5);
  }

  void forward() {
    agent.update_all_tables(params, tables);
    agent.encode_missions(params, tables, missions, cache);
    agent.forward(params, tables, frames, missions, agent.text(cache), cache);
  }
};

}  // namespace wordgaze::test
