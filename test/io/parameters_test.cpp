#include "wordgaze/io/parameters.hpp"

#include <gtest/gtest.h>

#include "wordgaze/policy/trained_agent.hpp"

namespace wordgaze::io {
namespace {

using policy::Agent;

Agent::Params random_params(const Agent& agent, std::uint64_t seed) {
  core::Rng rng(seed);
  return agent.initialize(rng);
}

bool never(const nn::Path&) { return false; }

TEST(Parameters, ComeBackAsTheyWere) {
  const Agent agent(model::Config{}, model::CellAlphabet::one_room());
  const auto params = random_params(agent, 1);
  TensorMap map;
  put_parameters(map, "adam.mean.", params);
  auto back = agent.make_params();
  get_parameters(map, "adam.mean.", never, back);
  nn::for_each_parameter(
      [](const nn::Path& path, const auto& a, const auto& b) { EXPECT_EQ(a, b) << path.str(); },
      params, back);
  EXPECT_TRUE(map.tensors.contains("adam.mean.visual.weight"));
  EXPECT_FALSE(map.tensors.contains("adam.mean.patches.first.weight")) << "not of this encoder";
}

TEST(Parameters, OfASmallerVocabularyAreRead) {
  const Agent agent(model::Config{}, model::CellAlphabet::one_room());
  auto old = random_params(agent, 1);
  const Matrix<float> known = old.words.leftCols(50);
  old.words = known;  // five words have been added since
  TensorMap map;
  put_parameters(map, "", old);
  const auto fresh = random_params(agent, 2);
  auto now = fresh;
  get_parameters(map, "", never, now);
  EXPECT_EQ(now.words.leftCols(50), known);
  EXPECT_EQ(now.words.rightCols(5), fresh.words.rightCols(5));
  EXPECT_EQ(now.memory.input_weight, old.memory.input_weight);
}

TEST(Parameters, OfOtherSizesAreRefused) {
  const Agent agent(model::Config{}, model::CellAlphabet::one_room());
  TensorMap map;
  put_parameters(map, "", random_params(agent, 1));
  model::Config config;
  config.memory_size = 32;
  auto smaller = Agent(config, model::CellAlphabet::one_room()).make_params();
  EXPECT_THROW(get_parameters(map, "", never, smaller), std::runtime_error);
  map.tensors.erase("actor.output.bias");
  auto params = agent.make_params();
  EXPECT_THROW(get_parameters(map, "", never, params), std::runtime_error);
  // Where it may be missing, what was there stays.
  params.actor.output.bias.setConstant(3);
  get_parameters(
      map, "", [](const nn::Path& path) { return path.names[0] == "actor"; }, params);
  EXPECT_EQ(params.actor.output.bias(0), 3);
}

}  // namespace
}  // namespace wordgaze::io
