#include "wordgaze/policy/server.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/messages.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/policy/environment.hpp"

namespace wordgaze::policy {
namespace {

/// An agent without training whose policy is far from even.
TrainedAgent agent_with(model::Config config) {
  const Agent agent(config, model::CellAlphabet::everything());
  core::Rng rng(1);
  auto params = agent.initialize(rng);
  params.actor.output.weight *= 300;
  return {{agent, agent.make_weights(std::move(params))}};
}

model::Config small(bool task_attention = false) {
  model::Config config;
  config.sub_tasks = 4;
  config.task_attention = task_attention;
  return config;
}

/// A ball in an empty room, somewhere that depends on a number.
Request request(std::int64_t client, std::int64_t sequence, bool reset = false) {
  Request r{.client = client, .sequence = sequence, .reset = reset};
  r.mission = "go to the red ball";
  for (std::size_t cell = 0; cell < grid::kViewCells; ++cell) r.image[3 * cell] = 1;
  const auto ball = static_cast<std::size_t>(3 * ((17 * sequence + client) % grid::kViewCells));
  r.image[ball] = static_cast<std::uint8_t>(grid::Type::ball);
  r.image[ball + 1] = static_cast<std::uint8_t>(grid::Color::red);
  return r;
}

struct PolicyServer : ::testing::Test {
  explicit PolicyServer(const model::Config& config = small()) : trained(agent_with(config)) {}

  TrainedAgent trained;
  NetworkPolicy<Agent> policy{trained};
  Server server{policy, {.clients = 3}};

  /// What the server has to answer: a policy that is asked for one client alone, in order.
  struct Reference {
    explicit Reference(const TrainedAgent& agent) : policy(agent) {}
    Reply answer(const Request& r) {
      if (r.reset) policy.begin(0);
      Observation seen{.image = r.image, .sentence = babyai::sentence_of(r.mission)};
      std::ranges::copy(r.completion, seen.completion.begin());
      policy.observe(0, seen);
      const Decision decision = policy.decide(Greedy{})[0];
      AttentionRecord record;
      policy.attention(0, record);
      Reply reply{.client = r.client, .sequence = r.sequence};
      reply.action = static_cast<int>(decision.action);
      reply.value = decision.value;
      reply.word_weights = record.weights;
      reply.nowhere = record.nowhere;
      return reply;
    }
    NetworkPolicy<Agent> policy;
  };

  Reply ask(const Request& r) { return server.answer(r); }
  std::string error_of(const Request& r) {
    const Reply reply = server.answer(r);
    EXPECT_FALSE(reply.error.empty()) << "no error";
    EXPECT_EQ(reply.action, -1);
    EXPECT_TRUE(reply.probabilities.empty());
    EXPECT_EQ(reply.client, r.client);
    EXPECT_EQ(reply.sequence, r.sequence);
    return reply.error;
  }
};

/// The numbers of one and the same network, in whatever order they were summed.
void expect_same(const Reply& reply, const Reply& expected) {
  ASSERT_EQ(reply.error, "");
  ASSERT_EQ(reply.client, expected.client);
  ASSERT_EQ(reply.sequence, expected.sequence);
  ASSERT_EQ(reply.action, expected.action);
  ASSERT_NEAR(reply.value, expected.value, 1e-4);
  ASSERT_EQ(reply.word_weights.size(), expected.word_weights.size());
  for (std::size_t i = 0; i < reply.word_weights.size(); ++i) {
    ASSERT_NEAR(reply.word_weights[i], expected.word_weights[i], 1e-5);
  }
  ASSERT_NEAR(reply.nowhere, expected.nowhere, 1e-5);
}

TEST_F(PolicyServer, SaysWhatItDidAndWhereItLooked) {
  const Reply reply = ask(request(7, 1, true));
  ASSERT_EQ(reply.error, "");
  EXPECT_EQ(reply.client, 7);
  EXPECT_EQ(reply.sequence, 1);
  ASSERT_EQ(reply.probabilities.size(), 7u);
  EXPECT_NEAR(std::accumulate(reply.probabilities.begin(), reply.probabilities.end(), 0.0), 1,
              1e-5);
  EXPECT_GT(reply.probabilities.at(static_cast<std::size_t>(reply.action)), 0);
  EXPECT_EQ(babyai::text(reply.sentence), "go to the red ball");
  ASSERT_EQ(reply.word_weights.size(), 5u);
  EXPECT_NEAR(std::accumulate(reply.word_weights.begin(), reply.word_weights.end(), 0.0), 1, 1e-5);
  EXPECT_EQ(reply.word_mask, std::vector<float>(5, 1));
  EXPECT_NEAR(std::accumulate(reply.map.begin(), reply.map.end(), double{reply.nowhere}), 1, 1e-4);
}

TEST_F(PolicyServer, WithoutAttentionHasNoMapsToShow) {
  model::Config config = small();
  config.attention = false;
  const auto blind = agent_with(config);
  NetworkPolicy<Agent> own(blind);
  Server plain(own, {});
  const Reply reply = plain.answer(request(1, 1, true));
  EXPECT_EQ(reply.error, "");
  EXPECT_TRUE(reply.word_weights.empty());
  EXPECT_EQ(reply.map, (std::array<float, grid::kViewCells>{}));
}

TEST_F(PolicyServer, HasAMemoryForEachClient) {
  Server greedy(policy, {.clients = 3, .greedy = true});
  std::map<std::int64_t, std::unique_ptr<Reference>> references;
  for (std::int64_t n = 0; n < 60; ++n) {
    const std::int64_t client = n % 3 - 1;
    auto& reference = references[client];
    if (!reference) reference = std::make_unique<Reference>(trained);
    const Request r = request(client, n, n < 3 || n % 20 == 0);
    ASSERT_NO_FATAL_FAILURE(expect_same(greedy.answer(r), reference->answer(r))) << n;
  }
}

TEST_F(PolicyServer, RemembersWhatWasSeenUntilAReset) {
  const Reply first = ask(request(1, 1, true));
  ask(request(1, 2));
  Request again = request(1, 1);
  again.sequence = 3;
  const Reply later = ask(again);
  again.sequence = 4;
  again.reset = true;
  EXPECT_NE(later.value, first.value);
  EXPECT_EQ(ask(again).value, first.value);
}

TEST_F(PolicyServer, AnswersARepeatAlikeAndMovesNothing) {
  Server other(policy, {.clients = 3});
  std::vector<Reply> once, often;
  for (std::int64_t n = 1; n < 30; ++n) {
    const Request r = request(5, n, n == 1);
    once.push_back(other.answer(r));
    for (std::int64_t k = 0; k <= n % 4; ++k) {
      const Reply reply = ask(r);
      if (k == 0) often.push_back(reply);
      ASSERT_EQ(reply, often.back());
    }
  }
  EXPECT_EQ(once, often);
  EXPECT_EQ(server.counts().requests - server.counts().repeats, 29);
}

TEST_F(PolicyServer, AnswersAnErrorAgainAndMovesNothing) {
  ask(request(1, 1, true));
  Request bad = request(1, 2);
  bad.mission = "go to the moon";
  const std::string error = error_of(bad);
  EXPECT_EQ(error_of(bad), error);
  EXPECT_EQ(server.counts().errors, 1);
  EXPECT_EQ(server.counts().repeats, 1);
  // As if it had never been asked.
  NetworkPolicy<Agent> own(trained);
  Server other(own, {.clients = 3});
  other.answer(request(1, 1, true));
  EXPECT_EQ(ask(request(1, 3)), other.answer(request(1, 3)));
}

TEST_F(PolicyServer, NamesBothNumbersOfALateRequest) {
  ask(request(1, 40, true));
  ask(request(1, 57));
  const std::string error = error_of(request(1, 41));
  EXPECT_TRUE(contains(error, "request 41"));
  EXPECT_TRUE(contains(error, "request 57"));
  EXPECT_TRUE(contains(error_of(request(1, 40, true)), "57"));  // nor is an old reset one
  EXPECT_EQ(ask(request(1, 57)).error, "");
  // Numbers may be any.
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  Request large = request(kMost, 1, true), least = request(kLeast, 1, true);
  large.sequence = kMost;
  least.sequence = kLeast;
  EXPECT_EQ(ask(large).error, "");
  EXPECT_EQ(ask(least).error, "");
  EXPECT_EQ(ask(large).error, "");
}

TEST_F(PolicyServer, TellsARepeatFromAnotherRequestOfTheSameNumber) {
  ask(request(1, 1, true));
  const Reply second = ask(request(1, 2));
  for (const auto change : std::vector<void (*)(Request&)>{
           [](Request& r) { r.mission = "pick up the red ball"; },
           [](Request& r) { r.image[0] = 2, r.image[1] = 5; }, [](Request& r) { r.reset = true; },
           [](Request& r) { r.direction = 3; }, [](Request& r) { r.completion = {0}; }}) {
    Request other = request(1, 2);
    change(other);
    EXPECT_TRUE(contains(error_of(other), "a number of its own"));
  }
  EXPECT_EQ(ask(request(1, 2)), second);
}

TEST_F(PolicyServer, WantsAResetOfWhomItDoesNotKnow) {
  EXPECT_TRUE(contains(error_of(request(9, 1)), "client 9 is not known"));
  EXPECT_EQ(server.clients(), 0u);
  EXPECT_EQ(ask(request(9, 1, true)).error, "");
  EXPECT_EQ(server.counts().clients, 1);
}

TEST_F(PolicyServer, EvictsTheLongestSilentAndTellsIt) {
  for (const std::int64_t client : {1, 2, 3}) ask(request(client, 10, true));
  ask(request(1, 10));  // even a late one is a sign of life; here a changed one
  EXPECT_EQ(ask(request(4, 1, true)).error, "");
  EXPECT_EQ(server.clients(), 3u);
  EXPECT_EQ(server.counts().evictions, 1);
  EXPECT_EQ(ask(request(1, 11)).error, "");
  const std::string told = error_of(request(2, 11));
  EXPECT_TRUE(contains(told, "client 2 was evicted"));
  EXPECT_TRUE(contains(told, "more than 3 clients"));
  EXPECT_TRUE(contains(told, "reset"));
  // A reset that was on its way for a long time begins nothing.
  EXPECT_TRUE(contains(error_of(request(2, 10, true)), "comes late"));
  EXPECT_TRUE(contains(error_of(request(2, 9, true)), "request 10"));
  EXPECT_EQ(ask(request(2, 12, true)).error, "");
  EXPECT_EQ(ask(request(2, 13)).error, "");
  EXPECT_EQ(server.counts().clients, 4);
  EXPECT_EQ(server.counts().evictions, 2);
}

TEST_F(PolicyServer, IsBoundedHoweverManyClientsCome) {
  for (std::int64_t client = 0; client < 500; ++client) {
    ASSERT_EQ(ask(request(client, 1, true)).error, "");
    ASSERT_LE(server.clients(), 3u);
  }
  EXPECT_EQ(server.counts().evictions, 497);
  EXPECT_TRUE(contains(error_of(request(490, 2)), "was evicted"));
  EXPECT_TRUE(contains(error_of(request(3, 2)), "is not known"));  // that too is forgotten
}

TEST_F(PolicyServer, NamesWhatItCannotRead) {
  ask(request(1, 1, true));
  std::int64_t n = 1;
  const auto error = [&](auto change) {
    Request r = request(1, ++n);
    change(r);
    return error_of(r);
  };
  const std::string words = error([](Request& r) { r.mission = "fly to the red moon"; });
  EXPECT_TRUE(contains(words, "'fly', 'moon'"));
  EXPECT_TRUE(contains(error([](Request& r) { r.mission.clear(); }), "mission is empty"));
  EXPECT_TRUE(contains(error([](Request& r) { r.mission = "   "; }), "mission is empty"));
  EXPECT_TRUE(contains(error([](Request& r) {
                         for (int k = 0; k < 15; ++k) r.mission += " and go to the ball";
                       }),
                       "more than 73 words"));
  EXPECT_TRUE(contains(error([](Request& r) { r.mission = std::string(2000, ' '); }),
                       "2000 characters; expected at most 1000"));
  EXPECT_TRUE(contains(error([](Request& r) { r.direction = 4; }), "direction is 4"));
  EXPECT_TRUE(contains(error([](Request& r) { r.direction = -2; }), "direction is -2"));
  for (const auto& code : std::vector<std::array<std::uint8_t, 3>>{
           {11, 0, 0}, {255, 255, 255}, {6, 6, 0}, {6, 0, 3}, {10, 0, 0}, {1, 1, 0}, {2, 0, 0}}) {
    const std::string cell =
        error([&](Request& r) { std::ranges::copy(code, r.image.begin() + 3 * (7 * 5 + 2)); });
    EXPECT_TRUE(contains(cell, "cell (5, 2)"));
    EXPECT_TRUE(contains(cell, "type " + std::to_string(code[0]) + ", color " +
                                   std::to_string(code[1]) + ", state " + std::to_string(code[2])));
  }
  EXPECT_TRUE(contains(error([](Request& r) {
                         r.completion = {0, 0};
                       }),
                       "2 entries, mission 'go to the red ball' has 1 sub-tasks"));
  EXPECT_TRUE(contains(error([](Request& r) { r.completion = {2}; }), "holds 2"));
  EXPECT_TRUE(contains(error([](Request& r) { r.completion.assign(60'000, 0); }), "60000 entries"));
  // All that has moved nothing.
  NetworkPolicy<Agent> own(trained);
  Server other(own, {.clients = 3});
  other.answer(request(1, 1, true));
  EXPECT_EQ(ask(request(1, 99)), other.answer(request(1, 99)));
  EXPECT_EQ(server.counts().errors, n - 1);
}

TEST_F(PolicyServer, AnswersInPrintableAscii) {
  Request r = request(1, 1, true);
  r.mission = "geh zum gr\xC3\xBCnen \x1B[31mBall\n";
  r.mission.push_back('\0');
  const std::string error = error_of(r);
  EXPECT_TRUE(contains(error, "gr??nen"));
  EXPECT_TRUE(std::ranges::all_of(error, [](char c) { return c >= ' ' && c <= '~'; }));
}

// A client that has no memory gets none by what cannot be answered.
TEST_F(PolicyServer, BeginsNothingWithABadRequest) {
  Request bad = request(1, 1, true);
  bad.mission = "go to the moon";
  error_of(bad);
  EXPECT_EQ(server.clients(), 0u);
  EXPECT_EQ(ask(request(1, 1, true)).error, "");
}

struct TaskServer : PolicyServer {
  TaskServer() : PolicyServer(small(true)) {}
};

TEST_F(TaskServer, ReadsWhatIsDone) {
  Request r = request(1, 1, true);
  r.mission = "go to the red ball, then pick up the blue key";
  const Reply none = ask(r);
  ASSERT_EQ(none.error, "");
  const auto masks = [&](std::vector<std::uint8_t> completion) {
    ++r.sequence;
    r.completion = std::move(completion);
    const Reply reply = ask(r);
    EXPECT_EQ(reply.error, "");
    return reply.word_mask;
  };
  EXPECT_EQ(masks({0, 0}), none.word_mask);
  EXPECT_NE(masks({1, 0}), none.word_mask);
  ++r.sequence;
  r.completion = {0};
  EXPECT_TRUE(contains(error_of(r), "has 2 sub-tasks"));
  ++r.sequence;
  r.completion = {};
  r.mission =
      "put the red ball next to the blue key, then put the red ball next to the red box, "
      "then go to the red ball";
  EXPECT_TRUE(contains(error_of(r), "has 5 sub-tasks"));
}

// What the network makes of weights beyond all measure.
TEST_F(PolicyServer, SendsNoNumberThatIsNone) {
  auto params = trained.weights.params;
  params.critic.output.bias.setConstant(std::numeric_limits<float>::max());
  params.critic.output.weight.setConstant(std::numeric_limits<float>::max());
  params.memory.bias.setConstant(100);
  const TrainedAgent wild{{trained.agent, trained.agent.make_weights(std::move(params))}};
  NetworkPolicy<Agent> own(wild);
  Server broken(own, {});
  const Reply reply = broken.answer(request(1, 1, true));
  EXPECT_TRUE(contains(reply.error, "not finite"));
  EXPECT_EQ(reply.value, 0);
  EXPECT_EQ(broken.clients(), 0u);
}

TEST_F(PolicyServer, DrawsDependOnSeedClientAndNumberAlone) {
  NetworkPolicy<Agent> first(trained), second(trained), third(trained);
  Server alone(first, {.seed = 5}), busy(second, {.seed = 5}), other(third, {.seed = 6});
  std::vector<int> a, b, c;
  for (std::int64_t n = 1; n < 100; ++n) {
    const Request r = request(1, n, n == 1);
    a.push_back(alone.answer(r).action);
    busy.answer(request(2, n, n % 3 == 1));
    b.push_back(busy.answer(r).action);
    c.push_back(other.answer(r).action);
  }
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
}

TEST_F(PolicyServer, DrawsAsThePolicyHasIt) {
  NetworkPolicy<Agent> own(trained);
  Server drawn(own, {});
  std::vector<double> expected(7), seen(7);
  constexpr int kDraws = 4000;
  for (int n = 0; n < kDraws; ++n) {
    Request r = request(1, 1, true);  // always the same view
    r.sequence = n;
    const Reply reply = drawn.answer(r);
    for (std::size_t k = 0; k < 7; ++k) expected[k] += static_cast<double>(reply.probabilities[k]);
    ++seen[static_cast<std::size_t>(reply.action)];
  }
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_NEAR(seen[k], expected[k], 4 * std::sqrt(expected[k]) + 4) << k;
  }
}

// A network that loses, repeats and reorders requests and replies, between clients that ask again
// until they are answered, more of them than the server has room for.
TEST_F(PolicyServer, IsRightOverAnyNetwork) {
  struct Robot {
    std::unique_ptr<Reference> reference;
    Request waiting;  // for the answer to this one
    Reply expected;
    std::map<std::int64_t, Reply> answered;
    int resets = 0;
  };
  NetworkPolicy<Agent> own(trained);
  Server greedy(own, {.clients = 3, .greedy = true});
  std::mt19937 random(2);
  const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
  std::vector<Robot> robots(5);
  const auto next = [&](Robot& robot, std::int64_t id, bool reset) {
    robot.waiting = request(id, robot.waiting.sequence + 1 + random() % 3, reset);
    robot.expected = robot.reference->answer(robot.waiting);
    robot.resets += reset;
  };
  for (std::size_t id = 0; id < robots.size(); ++id) {
    robots[id].reference = std::make_unique<Reference>(trained);
    next(robots[id], static_cast<std::int64_t>(id), true);
  }
  std::deque<Request> on_the_way;
  int answers = 0, told = 0;
  for (int round = 0; round < 12'000; ++round) {
    // Robots of small numbers ask more often.
    const std::size_t id = std::min({random() % 5, random() % 5});
    Robot& robot = robots[id];
    const int copies = on_the_way.size() > 12 ? 0 : chance(20) ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
      if (!chance(15)) on_the_way.push_back(robot.waiting);
    }
    if (on_the_way.empty()) continue;
    // The oldest, or any: what is left behind comes late.
    const std::size_t which = chance(70) ? 0 : random() % on_the_way.size();
    const Request arrived = on_the_way[which];
    on_the_way.erase(on_the_way.begin() + static_cast<std::ptrdiff_t>(which));
    const Reply reply = greedy.answer(arrived);
    ASSERT_LE(greedy.clients(), 3u);
    Robot& asking = robots[static_cast<std::size_t>(arrived.client)];
    if (reply.error.empty()) {
      const auto [known, is_new] = asking.answered.emplace(reply.sequence, reply);
      ASSERT_TRUE(is_new || known->second == reply) << "a number with two answers";
    }
    if (chance(15) || arrived.sequence != asking.waiting.sequence) continue;  // lost, or late
    if (reply.error.empty()) {
      ASSERT_NO_FATAL_FAILURE(expect_same(reply, asking.expected));
      ++answers;
      next(asking, arrived.client, chance(5));
    } else {
      ASSERT_TRUE(contains(reply.error, "evicted") || contains(reply.error, "comes late"))
          << reply.error;
      ++told;
      next(asking, arrived.client, true);
    }
  }
  EXPECT_GT(answers, 2000);
  EXPECT_GT(told, 20);
  EXPECT_GT(greedy.counts().repeats, 200);
}

TEST_F(PolicyServer, RefusesToHaveRoomForNobody) {
  EXPECT_THROW(Server(policy, {.clients = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace wordgaze::policy
