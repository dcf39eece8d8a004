#include "wordgaze/policy/policy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "wordgaze/policy/environment.hpp"

namespace wordgaze::policy {
namespace {

/// An agent without training.
TrainedAgent agent_with(model::Config config) {
  const Agent agent(config, model::CellAlphabet::one_room());
  core::Rng rng(1);
  auto params = agent.initialize(rng);
  params.actor.output.weight *= 300;  // its policy is far from even
  return {{agent, agent.make_weights(std::move(params))}};
}

model::Config with(int sub_tasks, bool task_attention) {
  model::Config config;
  config.sub_tasks = sub_tasks;
  config.task_attention = task_attention;
  return config;
}

/// A view from nowhere: one object straight ahead in an empty room.
Observation view(const std::string& mission, grid::Type type, grid::Color color) {
  Observation o;
  for (std::size_t cell = 0; cell < grid::kViewCells; ++cell) o.image[3 * cell] = 1;
  const std::size_t ahead = 3 * grid::kViewSize + 3;
  o.image[3 * ahead] = static_cast<std::uint8_t>(type);
  o.image[3 * ahead + 1] = static_cast<std::uint8_t>(color);
  o.sentence = babyai::sentence_of(mission);
  return o;
}

const Observation kBall = view("go to the red ball", grid::Type::ball, grid::Color::red);

std::vector<float> logits_of(const Policy& policy, int lane) {
  const auto z = policy.logits(lane);
  return {z.begin(), z.end()};
}

TEST(Policy, TellsTheAgentWhatIsInItsHand) {
  env::Environment environment("BabyAI-PutNextLocal-v0");
  environment.reset(3);
  const auto trained = agent_with(with(4, true));
  NetworkPolicy policy(trained);
  policy.observe(0, observe(environment));
  EXPECT_EQ(policy.frames().completion.sum(), 0);
  environment.take_object(
      static_cast<grid::ObjectId>(std::countr_zero(environment.meaning().object[0])));
  policy.observe(0, observe(environment));
  EXPECT_EQ(policy.frames().completion(0, 0), 1);
  EXPECT_EQ(policy.frames().completion.sum(), 1);
}

TEST(Policy, RefusesMoreSubTasksThanItsCompletionVectorHolds) {
  env::Environment environment("BabyAI-PutNextLocal-v0");
  environment.reset(3);
  const auto o = observe(environment);
  const auto small = agent_with(with(1, true)), large = agent_with(with(2, true)),
             blind = agent_with(with(1, false));
  EXPECT_THROW(NetworkPolicy(small).observe(0, o), std::invalid_argument);
  EXPECT_NO_THROW(NetworkPolicy(large).observe(0, o));
  EXPECT_NO_THROW(NetworkPolicy(blind).observe(0, o));  // it reads no c_t
}

TEST(Policy, RefusesWhatItCannotReadAndStaysAsItWas) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  policy.observe(0, kBall);
  policy.decide(Greedy{});
  const auto before = logits_of(policy, 0);
  policy.begin(0);
  Observation foreign = kBall, idle = kBall;
  foreign.image[0] = 4;  // a door, in an alphabet of rooms without
  idle.actions = 0;
  EXPECT_THROW(policy.observe(0, foreign), std::invalid_argument);
  EXPECT_THROW(policy.observe(0, idle), std::invalid_argument);
  idle.actions = grid::kActions + 1;
  EXPECT_THROW(policy.observe(0, idle), std::invalid_argument);
  EXPECT_THROW(policy.observe(1, kBall), std::invalid_argument);
  EXPECT_THROW(policy.begin(-1), std::invalid_argument);
  policy.decide(Greedy{});
  EXPECT_EQ(logits_of(policy, 0), before);
}

TEST(Policy, DecidesNothingBeforeEveryLaneHasObserved) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained, 2);
  policy.observe(0, kBall);
  EXPECT_THROW(policy.decide(Greedy{}), std::logic_error);
  EXPECT_THROW(policy.values(), std::logic_error);
  policy.observe(1, kBall);
  EXPECT_NO_THROW(policy.decide(Greedy{}));
}

TEST(Policy, ADecisionSaysWhatWasChosenAndHowSurely) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  policy.observe(0, kBall);
  const Decision greedy = policy.decide(Greedy{})[0];
  std::array<double, grid::kActions> p;
  double sum = 0, entropy = 0;
  for (std::size_t a = 0; a < p.size(); ++a) sum += p[a] = std::exp(policy.logits(0)[a]);
  for (double& x : p) x /= sum;
  for (const double x : p) entropy -= x * std::log(x);
  EXPECT_NEAR(std::exp(greedy.log_prob), p[greedy.action], 1e-5);
  EXPECT_EQ(p[greedy.action], *std::max_element(p.begin(), p.end()));
  EXPECT_NEAR(greedy.entropy, entropy, 1e-4);
  EXPECT_EQ(greedy.as_action(), static_cast<grid::Action>(greedy.action));
  // The chosen action is the sampler's.
  policy.begin(0);
  const Decision chosen = policy.decide([](int, auto) { return std::size_t{5}; })[0];
  EXPECT_EQ(chosen.action, 5u);
  EXPECT_NEAR(std::exp(chosen.log_prob), p[5], 1e-5);
  EXPECT_EQ(chosen.value, greedy.value);
}

TEST(Policy, DecidesWithoutWords) {
  const auto trained = agent_with(with(4, true));
  NetworkPolicy policy(trained);
  Observation silent = kBall;
  silent.sentence = {};
  policy.observe(0, silent);
  const Decision decision = policy.decide(Greedy{})[0];
  EXPECT_TRUE(std::isfinite(decision.log_prob) && std::isfinite(decision.value));
  AttentionRecord record;
  policy.attention(0, record);
  EXPECT_TRUE(record.weights.empty() && record.maps.empty());
  EXPECT_EQ(record.gaze.size(), std::size_t{grid::kViewCells});
}

TEST(Policy, DecidesAmongTheActionsThatArePossible) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained, 2), all(trained, 2);
  Observation narrow = kBall;
  narrow.actions = 3;
  for (int lane : {0, 1}) all.observe(lane, kBall);
  policy.observe(0, narrow);
  policy.observe(1, kBall);
  const auto unmasked = all.decide(Greedy{});
  std::vector<std::size_t> choices;
  const auto decisions = policy.decide([&](int, std::span<const float> log_probs) {
    choices.push_back(log_probs.size());
    double sum = 0;
    for (const float l : log_probs) sum += std::exp(static_cast<double>(l));
    EXPECT_NEAR(sum, 1, 1e-5);
    return log_probs.size() - 1;
  });
  EXPECT_EQ(choices, (std::vector<std::size_t>{3, grid::kActions}));
  EXPECT_EQ(policy.logits(0).size(), 3u);
  std::array<float, grid::kActions> all_log_probs;
  nn::Categorical<float>::log_softmax(all.logits(1), all_log_probs);
  EXPECT_EQ(decisions[1].log_prob, all_log_probs.back());
  EXPECT_EQ(decisions[0].value, unmasked[0].value);
  // Of three equally likely actions none could say more than log 3.
  EXPECT_LE(decisions[0].entropy, std::log(3.0f) + 1e-6f);
  const auto asked = policy.policies_for(0, policy.frames().cells.col(0));
  EXPECT_NEAR(asked.topRows(3).sum(), 1, 1e-5);
  EXPECT_EQ(asked.bottomRows(grid::kActions - 3).sum(), 0);
}

TEST(Policy, RemembersWithinAnEpisodeAlone) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  policy.observe(0, kBall);
  policy.decide(Greedy{});
  const auto first = logits_of(policy, 0);
  policy.decide(Greedy{});
  EXPECT_NE(logits_of(policy, 0), first);
  policy.begin(0);
  policy.decide(Greedy{});
  EXPECT_EQ(logits_of(policy, 0), first);
}

TEST(Policy, LanesDoNotMix) {
  const auto trained = agent_with(with(4, false));
  const auto key = view("pick up the blue key", grid::Type::key, grid::Color::blue);
  NetworkPolicy both(trained, 2), alone(trained);
  both.observe(0, kBall);
  both.observe(1, key);
  alone.observe(0, key);
  for (int t = 0; t < 3; ++t) {
    both.decide(Greedy{});
    alone.decide(Greedy{});
    for (std::size_t a = 0; a < grid::kActions; ++a) {
      EXPECT_NEAR(both.logits(1)[a], alone.logits(0)[a], 1e-3);
    }
  }
}

TEST(Policy, ValuesAskTheCriticAndDecideNothing) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  policy.observe(0, kBall);
  const float value = policy.values()[0];
  EXPECT_EQ(policy.values()[0], value);
  EXPECT_EQ(policy.decide(Greedy{})[0].value, value);
  EXPECT_NE(policy.values()[0], value);  // the memory has gone on
}

TEST(Policy, MemoryIsTakenOutAndPutBack) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained), other(trained);
  policy.observe(0, kBall);
  for (int t = 0; t < 3; ++t) policy.decide(Greedy{});
  const auto memory = policy.memory(0);
  EXPECT_FALSE(memory.begins);
  policy.decide(Greedy{});
  other.observe(0, kBall);
  EXPECT_TRUE(other.memory(0).h.isZero());
  other.set_memory(0, memory);
  other.decide(Greedy{});
  EXPECT_EQ(logits_of(policy, 0), logits_of(other, 0));
}

TEST(Policy, KeepsFinalObservationsUntilTheyAreValued) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained, 2);
  policy.observe(0, kBall);
  policy.observe(1, view("pick up the blue key", grid::Type::key, grid::Color::blue));
  policy.decide(Greedy{});
  std::vector<float> expected;
  for (int k = 0; k < 3; ++k) {  // more than there are lanes
    const int lane = k % 2;
    policy.observe(lane, view("go to the green box", grid::Type::box,
                              k == 2 ? grid::Color::red : grid::Color::green));
    expected.push_back(policy.values()[static_cast<std::size_t>(lane)]);
    policy.keep(lane);
    policy.observe(lane, kBall);  // the next episode
  }
  const auto values = policy.kept_values();
  ASSERT_EQ(values.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(values[k], expected[k], 1e-5) << k;
  EXPECT_TRUE(policy.kept_values().empty());
}

TEST(Policy, TheMissionMayChangeAtAnyTime) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained), fresh(trained);
  auto other = kBall;
  other.sentence = babyai::sentence_of("pick up the red ball");
  policy.observe(0, kBall);
  policy.decide(Greedy{});
  policy.begin(0);
  policy.observe(0, other);
  policy.decide(Greedy{});
  fresh.observe(0, other);
  fresh.decide(Greedy{});
  EXPECT_EQ(logits_of(policy, 0), logits_of(fresh, 0));
}

TEST(Policy, DoesNotGrowWithTheMissionsItHasHeard) {
  const auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  MissionTable table(3);
  const int held = table.acquire({kBall.sentence, {}});
  Observation o = kBall;
  for (int k = 0; k < 1000; ++k) {
    o.sentence = {};
    for (int word = 0; word < 4; ++word) {
      o.sentence.append(static_cast<babyai::WordId>(1 + (k >> (2 * word)) % 4 + 5 * word), 0);
    }
    o.sentence.append(static_cast<babyai::WordId>(1 + k % 50), 0);
    table.release(table.acquire({o.sentence, {}}));
    policy.observe(0, o);
    policy.decide(Greedy{});
  }
  EXPECT_LE(table.missions().size(), 6);
  EXPECT_EQ(table[held], kBall.sentence);
  EXPECT_LE(table.fresh().size(), 6u);
  // And what it says is what an agent says that has heard nothing else.
  NetworkPolicy fresh(trained);
  fresh.observe(0, o);
  policy.begin(0);
  policy.decide(Greedy{});
  fresh.decide(Greedy{});
  for (std::size_t a = 0; a < grid::kActions; ++a) {
    EXPECT_NEAR(policy.logits(0)[a], fresh.logits(0)[a], 1e-4);
  }
}

TEST(Policy, SeesChangedWeightsAfterRefresh) {
  auto trained = agent_with(with(4, false));
  NetworkPolicy policy(trained);
  policy.observe(0, kBall);
  policy.decide(Greedy{});
  const auto before = logits_of(policy, 0);
  trained.weights.params.text.bias.setConstant(3);  // the text feature, which the policy remembers
  trained.agent.refresh(trained.weights);
  policy.refresh();
  policy.begin(0);
  policy.decide(Greedy{});
  EXPECT_NE(logits_of(policy, 0), before);
}

TEST(EnvironmentPolicy, ActsAsTheAgentDoes) {
  const auto trained = std::make_shared<TrainedAgent>(agent_with(with(4, false)));
  const auto maker = EnvironmentPolicy::maker(trained, true);
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  environment.reset(7);
  const auto acts = maker(environment.id(), 7, 0);
  NetworkPolicy policy(*trained);
  for (int t = 0; t < 10; ++t) {
    policy.observe(0, observe(environment));
    const auto action = policy.decide(Greedy{})[0].as_action();
    EXPECT_EQ(acts(environment), action);
    const auto now = environment.step(action);
    if (now.terminated || now.truncated) break;
  }
}

}  // namespace
}  // namespace wordgaze::policy
