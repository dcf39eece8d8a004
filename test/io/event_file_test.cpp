#include "wordgaze/io/event_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/core/crc32.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

/// A reader of its own of TFRecords and of the fields of tensorflow.Event, from their published
/// descriptions.
struct Reader {
  std::string_view rest;

  template <class Number>
  Number fixed() {
    Number number;
    std::memcpy(&number, rest.data(), sizeof(number));
    rest.remove_prefix(sizeof(number));
    return number;
  }
  std::uint64_t varint() {
    std::uint64_t number = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(rest.front());
      rest.remove_prefix(1);
      number |= std::uint64_t{byte & 127u} << shift;
      if (byte < 128) return number;
    }
  }
  std::string_view text() {
    const auto size = static_cast<std::size_t>(varint());
    const std::string_view part = rest.substr(0, size);
    rest.remove_prefix(size);
    return part;
  }
};

std::uint32_t masked(std::string_view bytes) {
  const std::uint32_t crc = crc32c(bytes);
  return ((crc >> 15) | (crc << 17)) + 0xA282EAD8u;
}

struct Event {
  std::uint64_t step = 0;
  std::string version, tag;
  float value = 0;
  bool starts = false;
};

std::vector<Event> events_of(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::vector<Event> events;
  for (Reader records{content}; !records.rest.empty();) {
    const std::string_view length = records.rest.substr(0, 8);
    const auto size = records.fixed<std::uint64_t>();
    EXPECT_EQ(records.fixed<std::uint32_t>(), masked(length));
    const std::string_view data = records.rest.substr(0, size);
    records.rest.remove_prefix(size);
    EXPECT_EQ(records.fixed<std::uint32_t>(), masked(data));
    Event event;
    for (Reader fields{data}; !fields.rest.empty();) {
      switch (fields.varint()) {
        case 1 << 3 | 1:
          EXPECT_GT(fields.fixed<double>(), 1.7e9);
          break;
        case 2 << 3 | 0:
          event.step = fields.varint();
          break;
        case 3 << 3 | 2:
          event.version = fields.text();
          break;
        case 5 << 3 | 2: {
          Reader summary{fields.text()};
          EXPECT_EQ(summary.varint(), 1 << 3 | 2u);
          Reader value{summary.text()};
          EXPECT_EQ(value.varint(), 1 << 3 | 2u);
          event.tag = value.text();
          EXPECT_EQ(value.varint(), 2 << 3 | 5u);
          event.value = value.fixed<float>();
          break;
        }
        case 7 << 3 | 2:
          event.starts = fields.text() == std::string_view("\x08\x01");
          break;
        default:
          ADD_FAILURE() << "an odd field";
          return events;
      }
    }
    events.push_back(event);
  }
  return events;
}

// Of RFC 3720, appendix B.4.
TEST(Crc32c, IsThatOfTheStandard) {
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8A9136AAu);
  EXPECT_EQ(crc32c(std::string(32, '\xFF')), 0x62A8AB43u);
  EXPECT_EQ(crc32c("123456789"), 0xE3069283u);
}

TEST(EventFile, HoldsWhatTensorBoardReads) {
  const TemporaryFolder folder;
  EventFile file(folder / "board");
  file.add(128, "success_rate", 0.5);
  file.add(3'000'000'000, "entropy", std::nan(""));
  const auto events = events_of(file.path());  // nothing waits in a buffer
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].version, "brain.Event:2");
  EXPECT_EQ(events[1].tag, "success_rate");
  EXPECT_EQ(events[1].step, 128u);
  EXPECT_EQ(events[1].value, 0.5f);
  EXPECT_EQ(events[2].step, 3'000'000'000u);
  EXPECT_TRUE(std::isnan(events[2].value));
  EXPECT_TRUE(contains(file.path().filename().string(), "events.out.tfevents."));
}

TEST(EventFile, OfARunThatGoesOnMakesOlderStepsForgotten) {
  const TemporaryFolder folder;
  EventFile first(folder / "board");
  EventFile second(folder / "board", 640);
  EXPECT_LT(first.path(), second.path());
  const auto events = events_of(second.path());
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(events[1].starts);
  EXPECT_EQ(events[1].step, 640u);
}

TEST(EventFile, SaysWhyItCannotBeWritten) {
  const TemporaryFolder folder;
  write_file(folder / "file", "");
  EXPECT_THROW(EventFile(folder / "file" / "board"), std::exception);
}

TEST(EventFile, OnAFullDiskSaysSoOnceAndGoesOn) {
  const TemporaryFolder folder;
  EventFile file(folder.path());
  {
    const SmallDisk disk(2000);
    for (int i = 0; i < 1000; ++i) file.add(i, "success_rate", 0.5);
  }
  EXPECT_TRUE(contains(file.problem(), "File too large; going on without it"));
}

}  // namespace
}  // namespace wordgaze::io
