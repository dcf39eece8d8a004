#include "lcm/event_log.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/log_events.hpp"
#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::lcm_io {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes kData{1, 2, 3};

/// All events from the beginning on, and where they end.
std::pair<std::vector<EventLog::Event>, std::uint64_t> read(const EventLog& log) {
  std::vector<EventLog::Event> events;
  std::uint64_t place = 0;
  while (const auto event = log.event_at(place)) {
    events.push_back(*event);
    place = event->end;
  }
  return {events, place};
}

void write(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string two_events() {
  const TemporaryFolder folder;
  EventLog log(folder / "a");
  log.append(5, -1, "FIRST", kData);
  log.append(6, 1'700'000'000'000'000, "SECOND", {});
  return io::read_file(folder / "a");
}

TEST(EventLog, WritesWhatLcmAndItselfRead) {
  const TemporaryFolder folder;
  write(folder / "a", two_events());
  EXPECT_EQ(
      events_of(folder / "a"),
      (std::vector<LogEvent>{{5, -1, "FIRST", kData}, {6, 1'700'000'000'000'000, "SECOND", {}}}));
  const EventLog log(folder / "a");
  const auto [events, end] = read(log);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].number, 5);
  EXPECT_EQ(events[0].utime, -1);
  EXPECT_EQ(events[0].channel, "FIRST");
  EXPECT_EQ(log.data(events[0]), kData);
  EXPECT_EQ(events[1].channel, "SECOND");
  EXPECT_EQ(events[1].data_size(), 0u);
  EXPECT_EQ(end, log.size());
}

TEST(EventLog, ReadsALogOfLcm) {
  const TemporaryFolder folder;
  {
    lcm::LogFile lcm((folder / "a").string(), "w");
    std::string data(200'000, 'x');  // more than is read at once
    lcm::LogEvent event{0, 7, "OTHER", static_cast<std::int32_t>(data.size()), data.data()};
    for (int i = 0; i < 3; ++i) ASSERT_EQ(lcm.writeEvent(&event), 0);
  }
  const EventLog log(folder / "a");
  const auto [events, end] = read(log);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[2].number, 2);
  EXPECT_EQ(log.data(events[2]), Bytes(200'000, 'x'));
  EXPECT_EQ(end, log.size());
}

TEST(EventLog, KnowsATornEventAtEveryByte) {
  const TemporaryFolder folder;
  const std::string whole = two_events();
  const std::size_t first = 28 + 5 + 3;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(folder / "a", std::string_view(whole).substr(0, size));
    const EventLog log(folder / "a");
    const auto [events, end] = read(log);
    EXPECT_EQ(events.size(), size < first ? 0u : 1u) << size;
    EXPECT_EQ(end, size < first ? 0 : first) << size;
    EXPECT_TRUE(log.is_torn_at(end)) << size;
    EXPECT_FALSE(log.has_event_behind(end)) << size;
  }
}

TEST(EventLog, BelievesNoLength) {
  const TemporaryFolder folder;
  const auto spoiled = [&](std::size_t at, std::string_view bytes) {
    std::string content = two_events();
    content.replace(at, bytes.size(), bytes);
    write(folder / "a", content);
    const EventLog log(folder / "a");
    return std::pair(log.event_at(0).has_value(), log.has_event_behind(0));
  };
  using namespace std::string_view_literals;
  // Channel and data: negative, far too large, empty, past the end of the file, too short.
  for (const auto length : {"\xff\xff\xff\xff"sv, "\x7f\xff\xff\xff"sv, "\0\0\0\0"sv,
                            "\0\0\0\x40"sv, "\0\0\0\x3f"sv, "\0\0\0\x04"sv}) {
    EXPECT_EQ(spoiled(20, length), std::pair(false, true));
  }
  for (const auto length : {"\xff\xff\xff\xff"sv, "\x7f\xff\xff\xff"sv, "\x80\0\0\0"sv,
                            "\0\0\0\x40"sv, "\0\0\0\x02"sv}) {
    EXPECT_EQ(spoiled(24, length), std::pair(false, true));
  }
  EXPECT_EQ(spoiled(4, "\x80"), std::pair(false, true));  // a number that is no count
  EXPECT_EQ(spoiled(3, "\x02"), std::pair(false, true));  // the sync word
}

TEST(EventLog, FindsAnEventBehindMuchElse) {
  const TemporaryFolder folder;
  for (const std::size_t before : {1u, 65'533u, 65'535u, 65'536u, 65'537u, 200'000u}) {
    std::string junk(before, '\0');
    for (std::size_t i = 0; i + 4 < before; i += 7) junk.replace(i, 4, "\xED\xA1\xDA\x01");
    write(folder / "a", junk + two_events());
    EXPECT_TRUE(EventLog(folder / "a").has_event_behind(0)) << before;
    write(folder / "a", junk);
    EXPECT_FALSE(EventLog(folder / "a").has_event_behind(0)) << before;
  }
}

TEST(EventLog, IsForOneWriter) {
  const TemporaryFolder folder;
  const EventLog log(folder / "a");
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { EventLog second(folder / "a"); }),
                       "another process is writing it"));
}

TEST(EventLog, TakesBackWhatDoesNotFitOnTheDisk) {
  const TemporaryFolder folder;
  EventLog log(folder / "a");
  const Bytes data(900);
  {
    const SmallDisk disk(5'000);
    int written = 0;
    while (!log.append(written, 0, "CHANNEL", data)) ++written;
    EXPECT_EQ(written, 5);
    EXPECT_EQ(events_of(folder / "a").size(), 5u);
    EXPECT_EQ(std::filesystem::file_size(folder / "a"), log.size());
  }
  EXPECT_FALSE(log.append(5, 0, "CHANNEL", data));
  EXPECT_EQ(events_of(folder / "a").size(), 6u);
}

}  // namespace
}  // namespace wordgaze::lcm_io
