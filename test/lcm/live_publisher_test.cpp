#include "wordgaze/lcm/live_publisher.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <lcm/lcm-cpp.hpp>
#include <thread>

#include "lcm/example_records.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze::lcm_io {
namespace {

/// LCM's file transport stands for the network: what was published can be read back.
std::string file_url(const std::filesystem::path& path) {
  return "file://" + path.string() + "?mode=w";
}

TEST(LivePublisher, PublishesWhatIsQueuedBeforeItEnds) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  {
    LivePublisher publisher(file_url(folder / "a.lcm"), {"run 1", ""}, 2);
    EXPECT_EQ(publisher.problem(), "");
    for (int episode = 0; episode < 4; ++episode) {
      publisher.on_begin(records.begin(episode));
      publisher.on_step(records.step(episode));
      publisher.on_end(records.end(episode));
    }
    publisher.on_update(records.update());
    EXPECT_EQ(publisher.dropped(), 0);
  }
  lcm::LogFile log((folder / "a.lcm").string(), "r");
  std::vector<std::int64_t> episodes;
  int messages = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    ++messages;
    if (event->channel != kStepChannel) continue;
    const std::span bytes(static_cast<const std::uint8_t*>(event->data),
                          static_cast<std::size_t>(event->datalen));
    episodes.push_back(decode<step_t>(bytes).episode_id);
  }
  EXPECT_EQ(messages, 2 * 3 + 1);
  EXPECT_EQ(episodes, (std::vector<std::int64_t>{0, 2}));
}

TEST(LivePublisher, DropsAndCountsInsteadOfWaitingForASlowTransport) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Nobody reads the pipe yet: the transport gets stuck as soon as it is full.
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  constexpr int kSteps = 2000, kQueue = 16;
  std::thread drain;
  {
    LivePublisher publisher(file_url(pipe), {}, 1, kQueue);
    for (int step = 0; step < kSteps; ++step) publisher.on_step(records.step(0, step));
    EXPECT_GT(publisher.dropped(), kSteps / 2);
    EXPECT_LT(publisher.dropped(), kSteps);
    drain = std::thread([reader] {
      std::array<char, 4096> buffer;
      ::fcntl(reader, F_SETFL, 0);
      while (::read(reader, buffer.data(), buffer.size()) > 0) {
      }
    });
  }
  drain.join();
  ::close(reader);
}

TEST(LivePublisher, RefusesWhatIsNoUrlOfLcm) {
  EXPECT_TRUE(contains(
      message_of<std::invalid_argument>([] { LivePublisher("http://example.org", Origin{}); }),
      "'http://example.org': expected udpm://"));
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
