// The network from headers alone: nothing of the library is linked.
#include <cstdio>

#include <wordgaze/model/agent.hpp>

int main() {
  using namespace wordgaze;
  const model::Agent<float> agent(model::Config{}, model::CellAlphabet::one_room());
  auto weights = agent.make_weights();
  weights.params.actor.output.bias(2) = 1;
  agent.refresh(weights);
  model::Frames<float> frames;
  frames.resize(agent.config, {1, 1});
  model::Missions missions;
  babyai::Sentence mission;
  mission.append(*babyai::word_id("ball"), 0);
  missions.index_of(mission);
  model::Agent<float>::Cache cache;
  model::Outputs<float> outputs;
  Matrix<float> text(agent.config.text_size, 1);
  agent.encode_text(weights, missions, cache, text);
  agent.forward(weights, frames, missions, text, cache, outputs);
  std::printf("the logit of 'forward' is %g\n", static_cast<double>(outputs.logits(2, 0)));
  return outputs.logits(2, 0) == 1 ? 0 : 1;
}
