#include "wordgaze/lcm/log_writer.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <stdexcept>

#include "lcm/example_records.hpp"
#include "support/log_events.hpp"
#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze::lcm_io {
namespace {

using Event = LogEvent;

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

TEST(LogWriter, ReplacesALogThatStandsThere) {
  const TemporaryFolder folder;
  for (const std::int64_t episode : {1, 2}) {
    LogWriter writer(folder / "a.lcm", {});
    play(writer, episode);
  }
  ASSERT_EQ(events_of(folder / "a.lcm").size(), 4u);
  EXPECT_EQ(events_of(folder / "a.lcm")[0].number, 0);
}

TEST(LogWriter, TellsOfRunsByTheirName) {
  const TemporaryFolder folder;
  {
    LogWriter writer(folder / "a.lcm", {"run 1", ""});
    for (const char* run : {"sampled", "greedy"}) {
      writer.on_run(run);
      play(writer, 0);
    }
  }
  const auto events = events_of(folder / "a.lcm");
  EXPECT_EQ(decode<episode_begin_t>(events.at(0).bytes).run_id, "sampled");
  EXPECT_EQ(decode<episode_begin_t>(events.at(4).bytes).run_id, "greedy");
}

/// A run of three updates that was killed in its fourth. An episode is open at the end of update 2.
struct KilledRun {
  static constexpr std::size_t kFirst = 5, kSecond = 8, kThird = 11, kAll = 13;  // events so far

  TemporaryFolder folder;
  std::filesystem::path log = folder / "a.lcm";
  ExampleRecords records;
  Origin origin{"run 1", ""};

  KilledRun() {
    LogWriter writer(log, origin);
    play(writer, 0);
    writer.on_update(records.update(1));
    writer.on_begin(records.begin(1));
    writer.on_step(records.step(1, 0));
    writer.on_update(records.update(2));
    writer.on_step(records.step(1, 1));
    writer.on_end(records.end(1));
    writer.on_update(records.update(3));
    writer.on_begin(records.begin(2));
    writer.on_step(records.step(2, 0));
  }

  std::string content() const { return io::read_file(log); }
  void set(std::string_view content) const { std::ofstream(log, std::ios::binary) << content; }

  /// Goes on from a checkpoint of an update with another metrics message; returns what was said.
  std::string go_on(std::int64_t update) const {
    LogWriter writer(log, origin, 1, update);
    writer.on_update(records.update(update + 1));
    EXPECT_EQ(writer.problem(), "");
    return writer.gap();
  }
  std::string refusal(std::int64_t update) const {
    return message_of<std::runtime_error>([&] { LogWriter writer(log, origin, 1, update); });
  }
};

TEST(LogWriter, GoesOnFromWhatTheCheckpointKnows) {
  const KilledRun run;
  const auto before = events_of(run.log);
  ASSERT_EQ(before.size(), KilledRun::kAll);
  const std::string content = run.content();
  for (const auto& [update, known] : std::vector<std::pair<std::int64_t, std::size_t>>{
           {0, 0}, {1, KilledRun::kFirst}, {2, KilledRun::kSecond}, {3, KilledRun::kThird}}) {
    run.set(content);
    EXPECT_EQ(run.go_on(update), "");
    const auto after = events_of(run.log);
    ASSERT_EQ(after.size(), known + 1) << update;
    EXPECT_TRUE(std::equal(after.begin(), after.end() - 1, before.begin())) << update;
    EXPECT_EQ(decode<metrics_t>(after.back().bytes).update, update + 1);
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(after[i].number, static_cast<std::int64_t>(i));
    }
  }
}

TEST(LogWriter, StartsALogThatIsNotThereOrEmpty) {
  const KilledRun run;
  std::filesystem::remove(run.log);
  EXPECT_EQ(run.go_on(2), "");
  EXPECT_EQ(events_of(run.log).size(), 1u);
  run.set("");
  EXPECT_EQ(run.go_on(2), "");
  EXPECT_EQ(events_of(run.log).size(), 1u);
}

TEST(LogWriter, SaysWhatIsMissing) {
  const KilledRun run;
  EXPECT_TRUE(contains(run.go_on(5), "ends with update 3, the checkpoint is of update 5"));
  EXPECT_EQ(events_of(run.log).size(), KilledRun::kThird + 1);
}

TEST(LogWriter, TellsOnlyOnceThatAnEpisodeBegins) {
  const KilledRun run;
  {
    LogWriter writer(run.log, run.origin, 1, 2);
    writer.on_begin(run.records.begin(1, 1));  // which is open in the log
    writer.on_step(run.records.step(1, 1));
  }
  EXPECT_EQ(channels_of(run.log).back(), "WORDGAZE_STEP");
  EXPECT_EQ(events_of(run.log).size(), KilledRun::kSecond + 1);
  {
    LogWriter writer(run.log, run.origin, 1, 2);
    writer.on_begin(run.records.begin(4, 1));  // which is not
  }
  EXPECT_EQ(channels_of(run.log).back(), "WORDGAZE_EPISODE_BEGIN");
  {
    LogWriter writer(run.log, run.origin, 1, 1);
    writer.on_begin(run.records.begin(1));  // which begins again
  }
  EXPECT_EQ(channels_of(run.log).back(), "WORDGAZE_EPISODE_BEGIN");
}

// At every byte of what the checkpoint does not know, and of the metrics that it knows last.
TEST(LogWriter, CutsATornEventAtEveryByte) {
  const KilledRun run;
  const std::string content = run.content();
  const auto before = events_of(run.log);
  ASSERT_EQ(run.go_on(2), "");
  const std::size_t known = std::filesystem::file_size(run.log);  // and one event
  for (std::size_t size = known - 400; size < content.size(); ++size) {
    run.set(content.substr(0, size));
    run.go_on(2);
    const auto after = events_of(run.log);
    ASSERT_EQ(decode<metrics_t>(after.back().bytes).update, 3) << size;
    ASSERT_LE(after.size(), KilledRun::kSecond + 1);
    ASSERT_TRUE(std::equal(after.begin(), after.end() - 1, before.begin())) << size;
  }
  // Not even the first event is whole.
  for (std::size_t size = 0; size < 28 + 22; ++size) {
    run.set(content.substr(0, size));
    run.go_on(0);
    ASSERT_EQ(events_of(run.log).size(), 1u) << size;
  }
}

TEST(LogWriter, LosesNothingWhereJunkStandsBehindTheLastEvent) {
  const KilledRun run;
  {
    LogWriter writer(run.log, run.origin, 1, 3);  // the log ends with the metrics of update 3
  }
  const std::string content = run.content();
  using namespace std::string_view_literals;
  for (const std::string& junk :
       {std::string(5000, '\0'), std::string(1, 'x'), std::string("\xED\xA1\xDA\x01"sv),
        std::string("\xED\xA1\xDA\x01 and no more of an event than that"sv)}) {
    run.set(content + junk);
    EXPECT_EQ(run.go_on(3), "");
    EXPECT_EQ(events_of(run.log).size(), KilledRun::kThird + 1);
  }
}

// A bit flipped in the last events: the log is refused and stays, or goes on readably.
TEST(LogWriter, SurvivesFlippedBits) {
  const KilledRun run;
  const std::string content = run.content();
  std::mt19937 random(1);
  int refused = 0;
  for (std::size_t at = content.size() - 3500; at < content.size(); at += 1 + random() % 2) {
    std::string spoiled = content;
    spoiled[at] = static_cast<char>(spoiled[at] ^ (1 << random() % 8));
    run.set(spoiled);
    const std::int64_t update = static_cast<std::int64_t>(random() % 5);
    try {
      run.go_on(update);
    } catch (const std::runtime_error&) {
      ASSERT_EQ(run.content(), spoiled) << at;
      ++refused;
      continue;
    }
    const auto after = events_of(run.log);
    ASSERT_FALSE(after.empty());
    ASSERT_EQ(decode<metrics_t>(after.back().bytes).update, update + 1) << at;
    std::size_t size = 0;
    for (const auto& event : after) size += 28 + event.channel.size() + event.bytes.size();
    ASSERT_EQ(size, std::filesystem::file_size(run.log)) << at;
  }
  EXPECT_LT(refused, 3500 / 4);
}

TEST(LogWriter, RefusesWhatIsNoLogAndLeavesItAlone) {
  const KilledRun run;
  std::string random(5000, '\0');
  std::mt19937 generator(1);
  for (char& byte : random) byte = static_cast<char>(generator());
  using namespace std::string_view_literals;
  for (const std::string& foreign :
       {std::string("Two roads diverged in a yellow wood\n"), std::string(1, 'x'),
        std::string(5000, '\0'), random, std::string(5000, '\xED'),
        std::string("\xED\xA1\xDA\x01 and no more of an event than that") + random}) {
    run.set(foreign);
    EXPECT_TRUE(contains(run.refusal(2), "a.lcm' holds no event of LCM; it stays as it is"));
    EXPECT_TRUE(
        contains(message_of<std::runtime_error>([&] { LogWriter writer(run.log, run.origin); }),
                 "holds no event of LCM"));
    EXPECT_EQ(run.content(), foreign);
  }
}

TEST(LogWriter, RefusesTheLogOfAnotherRunAndLeavesItAlone) {
  KilledRun run;
  run.origin.run_id = "run 2";
  const std::string content = run.content();
  EXPECT_TRUE(contains(run.refusal(2), "is of run 'run 1', this one is 'run 2'"));
  EXPECT_EQ(run.content(), content);
}

TEST(LogWriter, RefusesALogThatIsDamagedInWhatTheCheckpointKnows) {
  const KilledRun run;
  const std::string content = run.content();
  const std::size_t second = 28 + kEpisodeBeginChannel.size() + events_of(run.log)[0].bytes.size();
  for (const std::size_t place : {std::size_t{0}, second}) {
    std::string damaged = content;
    damaged[place] = 'x';
    run.set(damaged);
    EXPECT_TRUE(contains(run.refusal(2), "is damaged at byte " + std::to_string(place) +
                                             ", and more events follow"));
    EXPECT_EQ(run.content(), damaged);
  }
}

TEST(LogWriter, SaysThatItCannotOpen) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { LogWriter(folder / "no/a.lcm", Origin{}); }),
               "no/a.lcm': No such file or directory"));
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { LogWriter(folder.path(), Origin{}); }),
                       "Is a directory"));
}

TEST(LogWriter, EndsTheLogWithItsLastWholeEventOnAFullDisk) {
  const TemporaryFolder folder;
  LogWriter writer(folder / "a.lcm", {});
  {
    const SmallDisk disk(20'000);
    for (int episode = 0; episode < 20; ++episode) play(writer, episode);
  }
  EXPECT_TRUE(contains(writer.problem(), "cannot write the LCM log '"));
  EXPECT_TRUE(contains(writer.problem(), "a.lcm': File too large; going on without it"));
  const std::size_t written = events_of(folder / "a.lcm").size();
  EXPECT_GT(written, 4u);
  EXPECT_EQ(writer.lost(), static_cast<std::int64_t>(80 - written));
  // Room or not, what follows would have a hole before it.
  play(writer, 20);
  EXPECT_EQ(events_of(folder / "a.lcm").size(), written);
  EXPECT_EQ(writer.lost(), static_cast<std::int64_t>(84 - written));
}

}  // namespace
}  // namespace wordgaze::lcm_io
