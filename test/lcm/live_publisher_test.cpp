#include "wordgaze/lcm/live_publisher.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "lcm/example_records.hpp"
#include "support/messages.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze::lcm_io {
namespace {

TEST(LivePublisher, PublishesWhatIsQueuedBeforeItEnds) {
  const ExampleRecords records;
  std::vector<std::int64_t> episodes;
  int messages = 0;
  const auto publish = [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    ++messages;
    if (channel == kStepChannel) episodes.push_back(decode<step_t>(bytes).episode_id);
    return true;
  };
  {
    LivePublisher publisher(publish, {"run 1", ""}, 2);
    EXPECT_EQ(publisher.problem(), "");
    for (int episode = 0; episode < 4; ++episode) {
      publisher.on_begin(records.begin(episode));
      publisher.on_step(records.step(episode));
      publisher.on_end(records.end(episode));
    }
    publisher.on_update(records.update());
    EXPECT_EQ(publisher.dropped(), 0);
  }
  EXPECT_EQ(messages, 2 * 3 + 1);
  EXPECT_EQ(episodes, (std::vector<std::int64_t>{0, 2}));
}

TEST(LivePublisher, DropsAndCountsInsteadOfWaitingForASlowTransport) {
  const ExampleRecords records;
  constexpr int kSteps = 2000, kQueue = 16;
  std::promise<void> freed;
  const auto stuck = [free = freed.get_future().share()](const std::string&,
                                                         std::span<const std::uint8_t>) {
    free.wait();
    return true;
  };
  LivePublisher publisher(stuck, {}, 1, kQueue);
  for (int step = 0; step < kSteps; ++step) publisher.on_step(records.step(0, step));
  EXPECT_GE(publisher.dropped(), kSteps - kQueue - 1);
  EXPECT_LT(publisher.dropped(), kSteps);
  freed.set_value();
}

TEST(LivePublisher, CountsWhatTheTransportRefuses) {
  const ExampleRecords records;
  std::promise<void> asked;
  const auto refuses = [&](const std::string&, std::span<const std::uint8_t>) {
    asked.set_value();
    return false;
  };
  LivePublisher publisher(refuses, {});
  publisher.on_step(records.step(0));
  asked.get_future().wait();
  for (int i = 0; i < 5000 && publisher.dropped() == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(publisher.dropped(), 1);
}

TEST(LivePublisher, RefusesWhatIsNoUrlOfLcm) {
  EXPECT_TRUE(contains(
      message_of<std::invalid_argument>([] { LivePublisher("http://example.org", Origin{}); }),
      "'http://example.org': expected udpm://"));
  EXPECT_TRUE(
      contains(message_of<std::invalid_argument>([] { LivePublisher("memq://", Origin{}); }),
               "expected udpm://"));
}

// A network namespace of its own has no routes at all; only root may make one.
TEST(LivePublisher, NamesTheMissingRouteOnceAndGoesOn) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::unshare(CLONE_NEWNET) != 0) ::_exit(77);
    const ExampleRecords records;
    LivePublisher publisher("udpm://239.255.76.67:7667?ttl=0", {});
    const bool told =
        publisher.problem().find("ip route add 224.0.0.0/4 dev lo") != std::string::npos;
    publisher.on_step(records.step(0));
    publisher.on_update(records.update());
    ::_exit(told && publisher.dropped() == 2 ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "needs the right to make a network namespace";
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace wordgaze::lcm_io
