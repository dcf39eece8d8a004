#include "wordgaze/lcm/log_writer.hpp"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcm/example_records.hpp"
#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze::lcm_io {
namespace {

struct Event {
  std::string channel;
  std::int64_t timestamp;
  std::vector<std::uint8_t> bytes;
};

std::vector<Event> events_of(const std::filesystem::path& path) {
  lcm::LogFile log(path.string(), "r");
  EXPECT_TRUE(log.good());
  std::vector<Event> events;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    const auto* bytes = static_cast<const std::uint8_t*>(event->data);
    events.push_back({event->channel, event->timestamp, {bytes, bytes + event->datalen}});
  }
  return events;
}

std::vector<std::string> channels_of(const std::filesystem::path& path) {
  std::vector<std::string> channels;
  for (const Event& event : events_of(path)) channels.push_back(event.channel);
  return channels;
}

/// Tells the observer of one episode with two steps.
void play(policy::Observer& observer, std::int64_t episode) {
  const ExampleRecords records;
  observer.on_begin(records.begin(episode));
  observer.on_step(records.step(episode, 0));
  observer.on_step(records.step(episode, 1));
  observer.on_end(records.end(episode));
}

TEST(LogWriter, WritesALogThatLcmReads) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  LogWriter writer(folder / "a.lcm", {"run 1", ""});
  play(writer, 5);
  writer.on_update(records.update());
  // Nothing waits in a buffer: the writer is still open.
  const std::vector<Event> events = events_of(folder / "a.lcm");
  ASSERT_EQ(events.size(), 5u);
  EXPECT_EQ(channels_of(folder / "a.lcm"),
            (std::vector<std::string>{"WORDGAZE_EPISODE_BEGIN", "WORDGAZE_STEP", "WORDGAZE_STEP",
                                      "WORDGAZE_EPISODE_END", "WORDGAZE_METRICS"}));
  EXPECT_EQ(decode<episode_begin_t>(events[0].bytes).mission, records.mission);
  const auto step = decode<step_t>(events[2].bytes);
  EXPECT_EQ(step.step, 1);
  EXPECT_EQ(step.word_weights, records.weights);
  EXPECT_EQ(step.utime, events[2].timestamp);
  EXPECT_GT(step.utime, 1'700'000'000'000'000);  // microseconds since 1970, not something else
  EXPECT_EQ(decode<episode_end_t>(events[3].bytes).num_steps, 17);
  EXPECT_EQ(decode<metrics_t>(events[4].bytes).run_id, "run 1");
}

TEST(LogWriter, LogsEveryKthEpisodeAndAllMetrics) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  LogWriter writer(folder / "a.lcm", {}, 3);
  for (std::int64_t episode = 0; episode < 7; ++episode) {
    EXPECT_EQ(writer.wants_episode(episode), episode % 3 == 0);
    play(writer, episode);
    writer.on_update(records.update());
  }
  std::vector<std::int64_t> logged;
  int metrics = 0;
  for (const Event& event : events_of(folder / "a.lcm")) {
    if (event.channel == kEpisodeBeginChannel) {
      logged.push_back(decode<episode_begin_t>(event.bytes).episode_id);
    }
    metrics += event.channel == kMetricsChannel;
  }
  EXPECT_EQ(logged, (std::vector<std::int64_t>{0, 3, 6}));
  EXPECT_EQ(metrics, 7);
  EXPECT_EQ(events_of(folder / "a.lcm").size(), 3u * 4 + 7);
  EXPECT_THROW(LogWriter(folder / "b.lcm", {}, 0), std::invalid_argument);
}

TEST(LogWriter, StartsAnewOrAppends) {
  const TemporaryFolder folder;
  play(*std::make_unique<LogWriter>(folder / "a.lcm", Origin{}), 1);
  play(*std::make_unique<LogWriter>(folder / "a.lcm", Origin{}, 1, LogWriter::Mode::append), 2);
  EXPECT_EQ(events_of(folder / "a.lcm").size(), 8u);
  play(*std::make_unique<LogWriter>(folder / "a.lcm", Origin{}), 3);
  EXPECT_EQ(events_of(folder / "a.lcm").size(), 4u);
}

TEST(LogWriter, SaysThatItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { LogWriter(folder / "no/a.lcm", Origin{}); }),
               "no/a.lcm': No such file or directory"));
  const std::string message = message_of<std::runtime_error>([&] {
    LogWriter writer(folder / "a.lcm", {});
    const SmallDisk disk(20'000);
    for (int episode = 0; episode < 20; ++episode) play(writer, episode);
  });
  EXPECT_TRUE(contains(message, "cannot write the LCM log '"));
  EXPECT_TRUE(contains(message, "a.lcm': File too large"));
}

}  // namespace
}  // namespace wordgaze::lcm_io
