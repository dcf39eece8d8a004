#include "wordgaze/policy/recorder.hpp"

#include <gtest/gtest.h>

#include "wordgaze/policy/environment.hpp"

namespace wordgaze::policy {
namespace {

/// Keeps copies of what it is told.
struct Listener final : Observer {
  std::vector<std::int64_t> wanted{7}, begun, ended;
  int steps_before = -1;
  struct Step {
    int lane, step, action;
    float value, reward;
    bool terminated, truncated;
    std::size_t words;
    float weight_sum, map_sum;
    std::array<std::uint8_t, grid::kImageBytes> image;
  };
  std::vector<Step> steps;

  bool wants_episode(std::int64_t e) override {
    return std::find(wanted.begin(), wanted.end(), e) != wanted.end();
  }
  void on_begin(const EpisodeBegin& b) override {
    begun.push_back(b.episode);
    steps_before = b.steps;
  }
  void on_step(const StepRecord& s) override {
    const auto sum = [](std::span<const float> v) {
      float total = 0;
      for (const float x : v) total += x;
      return total;
    };
    steps.push_back({s.lane, s.step, s.action, s.value, s.reward, s.terminated, s.truncated,
                     s.word_weights.size(), sum(s.word_weights), sum(s.word_attention), s.image});
  }
  void on_end(const EpisodeEnd& e) override { ended.push_back(e.episode); }
};

TEST(Recorder, TellsWhatWasSeenDecidedAndWhatCameOfIt) {
  model::Config config;
  config.gaze = model::Gaze::sum;  // whose maps leave nothing to nowhere
  const Agent agent(config, model::CellAlphabet::one_room());
  core::Rng rng(1);
  const auto weights = agent.make_weights(agent.initialize(rng));
  NetworkPolicy<Agent> policy(agent, weights, 2);
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  environment.reset(1);
  const Observation before = observe(environment);
  for (const int lane : {0, 1}) policy.observe(lane, before);
  Listener listener;
  Recorder recorder(listener);
  EXPECT_FALSE(recorder.begin(6, 4, 1, environment));
  ASSERT_TRUE(recorder.begin(7, 4, 1, environment));  // lane 1 of the policy, reported as 4
  const Decision decision = policy.decide([](int, auto) { return std::size_t{0}; })[1];
  recorder.decide(policy, 1, environment, before, decision);
  const auto transition = environment.step(decision.as_action());
  recorder.step(transition);
  recorder.end({.episode = 7});
  EXPECT_EQ(listener.begun, std::vector<std::int64_t>{7});
  EXPECT_EQ(listener.ended, std::vector<std::int64_t>{7});
  ASSERT_EQ(listener.steps.size(), 1u);
  const auto& step = listener.steps[0];
  EXPECT_EQ(step.lane, 4);
  EXPECT_EQ(step.step, 0);
  EXPECT_EQ(step.action, 0);
  EXPECT_EQ(step.value, decision.value);
  EXPECT_EQ(step.image, before.image);
  EXPECT_NE(step.image, observe(environment).image);
  EXPECT_EQ(step.words, static_cast<std::size_t>(before.sentence.length));
  EXPECT_NEAR(step.weight_sum, 1, 1e-5);
  EXPECT_NEAR(step.map_sum, before.sentence.length, 1e-4);
  EXPECT_FALSE(step.terminated || step.truncated);
  EXPECT_EQ(listener.steps_before, 0);
}

// A run that goes on from a checkpoint may be in the middle of an episode.
TEST(Recorder, SaysHowManyStepsWereDoneBefore) {
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  environment.reset(1);
  for (int i = 0; i < 3; ++i) environment.step(grid::Action::left);
  Listener listener;
  Recorder recorder(listener);
  ASSERT_TRUE(recorder.begin(7, 0, 0, environment));
  EXPECT_EQ(listener.steps_before, 3);
}

}  // namespace
}  // namespace wordgaze::policy
