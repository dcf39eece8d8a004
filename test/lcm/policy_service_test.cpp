#include "wordgaze/lcm/policy_service.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/messages.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/lcm/origin.hpp"
#include "wordgaze/policy/network_policy.hpp"

namespace wordgaze::lcm_io {
namespace {

using Bytes = std::vector<std::uint8_t>;

policy::TrainedAgent untrained() {
  const policy::Agent agent(model::Config{}, model::CellAlphabet::everything());
  core::Rng rng(1);
  return {{agent, agent.make_weights(agent.initialize(rng))}};
}

policy::Request request(std::int64_t sequence, bool reset) {
  policy::Request r{.client = 1, .sequence = sequence, .reset = reset};
  r.mission = "go to the red ball";
  for (std::size_t cell = 0; cell < grid::kViewCells; ++cell) r.image[3 * cell] = 1;
  return r;
}

/// A robot and a server on one bus in memory.
struct PolicyServiceOnABus : ::testing::Test {
  PolicyServiceOnABus() {
    using Hear = void (*)(const lcm::ReceiveBuffer*, const std::string&, std::vector<Bytes>*);
    const Hear hear = [](const lcm::ReceiveBuffer* received, const std::string&,
                         std::vector<Bytes>* heard) {
      const auto* data = static_cast<const std::uint8_t*>(received->data);
      heard->emplace_back(data, data + received->data_size);
    };
    bus->subscribeFunction("WORDGAZE_POLICY_REPLY", hear, &replies);
  }

  /// Sends a message, and gives what came back.
  std::vector<Bytes> send(const Bytes& bytes) {
    replies.clear();
    bus->publish("WORDGAZE_POLICY_REQUEST", bytes.data(), static_cast<unsigned>(bytes.size()));
    service.serve(std::chrono::milliseconds(1000));
    while (bus->handleTimeout(0) > 0) {
    }
    return replies;
  }
  Bytes reply_to(const policy::Request& r, std::int64_t utime = 1) {
    const auto came = send(encode(to_message(r, utime)));
    EXPECT_EQ(came.size(), 1u);
    return came.at(0);
  }

  std::shared_ptr<lcm::LCM> bus = std::make_shared<lcm::LCM>("memq://");
  policy::TrainedAgent trained = untrained();
  policy::NetworkPolicy<policy::Agent> agent{trained};
  policy::Server server{agent, {.clients = 2}};
  PolicyService service{bus, server};
  std::vector<Bytes> replies;
};

TEST_F(PolicyServiceOnABus, Answers) {
  const auto reply = decode<policy_reply_t>(reply_to(request(3, true)));
  EXPECT_EQ(reply.error, "");
  EXPECT_EQ(reply.client_id, 1);
  EXPECT_EQ(reply.seq, 3);
  EXPECT_GE(reply.action, 0);
  EXPECT_EQ(reply.num_actions, 7);
  EXPECT_EQ(reply.tokens, (std::vector<std::string>{"go", "to", "the", "red", "ball"}));
  EXPECT_GT(reply.utime, 1'600'000'000'000'000);
}

TEST_F(PolicyServiceOnABus, AnswersARepeatWithTheSameBytesButForTheTime) {
  const auto timeless = [](Bytes bytes) {
    std::fill_n(bytes.begin() + 8, 8, std::uint8_t{0});
    return bytes;
  };
  reply_to(request(1, true));
  const Bytes once = reply_to(request(2, false)), again = reply_to(request(2, false), 99);
  EXPECT_NE(once, again);
  EXPECT_EQ(timeless(once), timeless(again));
}

TEST_F(PolicyServiceOnABus, AnswersByAnErrorWhatTheAgentCannotRead) {
  policy::Request bad = request(1, true);
  bad.mission = "go to the moon";
  const auto reply = decode<policy_reply_t>(reply_to(bad));
  EXPECT_TRUE(contains(reply.error, "'moon'"));
  EXPECT_EQ(reply.action, -1);
  EXPECT_EQ(reply.num_actions, 0);
  EXPECT_EQ(reply.num_tokens, 0);
}

TEST_F(PolicyServiceOnABus, CountsBytesThatAreNoRequestAndGoesOn) {
  const Bytes good = encode(to_message(request(1, true), 1));
  std::mt19937 random(3);
  int foreign = 0;
  for (std::size_t size = 0; size < good.size(); ++size, ++foreign) {
    EXPECT_TRUE(
        send(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).empty());
  }
  for (int n = 0; n < 200; ++n, ++foreign) {
    Bytes garbage(random() % 400);
    for (auto& byte : garbage) byte = static_cast<std::uint8_t>(random());
    EXPECT_TRUE(send(garbage).empty());
  }
  EXPECT_TRUE(send(encode(to_message(policy::Reply{}, 1))).empty());
  EXPECT_EQ(service.complaint(), "not a valid policy_request_t: its fingerprint is another");
  EXPECT_TRUE(send(Bytes(100'000)).empty());
  EXPECT_EQ(service.complaint(), "not a valid policy_request_t: it has 100000 bytes");
  EXPECT_EQ(service.counts().foreign, foreign + 2);
  EXPECT_EQ(server.counts().requests, 0);
  EXPECT_EQ(send(good).size(), 1u);
  EXPECT_EQ(service.counts().unsent, 0);
}

// Whatever arrives, the answer is one that a client can decode, or none.
TEST_F(PolicyServiceOnABus, SurvivesDamagedRequests) {
  const Bytes good = encode(to_message(request(1, true), 1));
  std::mt19937 random(4);
  std::size_t answered = 0;
  for (int n = 0; n < 5000; ++n) {
    Bytes damaged = good;
    for (std::size_t k = random() % 6; k > 0; --k) {
      damaged[8 + random() % (good.size() - 8)] = static_cast<std::uint8_t>(random());
    }
    for (const Bytes& bytes : send(damaged)) {
      EXPECT_NO_THROW(decode<policy_reply_t>(bytes));
      ++answered;
    }
  }
  EXPECT_GT(answered, 3000u);
  EXPECT_LE(server.clients(), 2u);
}

TEST_F(PolicyServiceOnABus, HearsNothingMoreWhenItIsGone) {
  { PolicyService other(bus, server); }
  EXPECT_EQ(send(encode(to_message(request(1, true), 1))).size(), 1u);
}

TEST_F(PolicyServiceOnABus, ReturnsWhenNothingComes) {
  service.serve(std::chrono::milliseconds(1));
  EXPECT_EQ(server.counts().requests, 0);
}

TEST(PolicyService, RefusesWhatIsNoUrlOfUdp) {
  const auto trained = untrained();
  policy::NetworkPolicy<policy::Agent> agent(trained);
  policy::Server server(agent, {});
  for (const char* url : {"memq://", "tcpq://localhost:7700", "udpm://127.0.0.1:7667"}) {
    EXPECT_THROW(PolicyService(url, server), std::invalid_argument) << url;
  }
}

// A network namespace of its own has no routes at all; only root may make one.
TEST(PolicyService, NamesTheMissingRoute) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::unshare(CLONE_NEWNET) != 0) ::_exit(77);
    const auto trained = untrained();
    policy::NetworkPolicy<policy::Agent> agent(trained);
    policy::Server server(agent, {});
    const auto message = message_of<std::runtime_error>(
        [&] { PolicyService("udpm://239.255.76.67:7667?ttl=0", server); });
    ::_exit(contains(message, "ip route add 224.0.0.0/4 dev lo") ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "needs the right to make a network namespace";
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace wordgaze::lcm_io
