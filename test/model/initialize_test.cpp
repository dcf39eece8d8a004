#include <gtest/gtest.h>

#include "model/agent_fixture.hpp"

namespace wordgaze::model {
namespace {

TEST(Initialize, TheSilentWordPrefersObjectsByThePrior) {
  Config config;
  config.object_prior = 3;
  const Agent<double> agent{config, CellAlphabet::everything()};
  core::Rng rng(1);
  const auto weights = agent.make_weights(agent.initialize(rng));
  for (int k = 0; k < agent.alphabet.size(); ++k) {
    const bool object = agent.alphabet[k].type >= 5 && agent.alphabet[k].type <= 7;
    EXPECT_NEAR(weights.tables.vision.cells.scores(k, kSilentWord), object ? 3 : 0, 1e-12);
  }
}

TEST(Initialize, InTheSumEveryWordPrefersObjectsByThePrior) {
  Config config;
  config.gaze = Gaze::sum;
  config.object_prior = 3;
  const Agent<double> agent{config, CellAlphabet::everything()};
  core::Rng rng(1);
  auto params = agent.initialize(rng);
  // The prior alone: entry 0 of queries and keys, channel 0 of the encoding.
  params.attention.query.bottomRows(config.key_size - 1).setZero();
  const auto weights = agent.make_weights(params);
  for (int k = 0; k < agent.alphabet.size(); ++k) {
    const bool object = agent.alphabet[k].type >= 5 && agent.alphabet[k].type <= 7;
    for (int word = 1; word < babyai::kVocabularySize; ++word) {
      EXPECT_NEAR(weights.tables.vision.cells.scores(k, word), object ? 3 : 0, 1e-12);
    }
  }
}

TEST(Initialize, TheSameStreamGivesTheSameWeights) {
  const Agent<float> agent{Config{}, CellAlphabet::one_room()};
  core::Rng a(5), b(5), c(6);
  const auto x = agent.initialize(a), y = agent.initialize(b), z = agent.initialize(c);
  EXPECT_EQ(x.memory.input_weight, y.memory.input_weight);
  EXPECT_NE(x.memory.input_weight, z.memory.input_weight);
}

TEST(Initialize, AllWordsAreBrightAtFirst) {
  Config config;
  config.task_attention = true;
  core::Rng rng(1);
  const Agent<float> scans{config, CellAlphabet::one_room()};
  EXPECT_EQ(scans.initialize(rng).task.scan.words.row(3).minCoeff(), 2);
  config.task_reader = Reader::sum;
  const Agent<float> sums{config, CellAlphabet::one_room()};
  EXPECT_EQ(sums.initialize(rng).task.output.bias.minCoeff(), 2);
}

}  // namespace
}  // namespace wordgaze::model
