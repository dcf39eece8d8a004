#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <vector>

namespace wordgaze {

/// An event of a log as LCM reads it.
struct LogEvent {
  std::int64_t number, timestamp;
  std::string channel;
  std::vector<std::uint8_t> bytes;

  bool operator==(const LogEvent&) const = default;
};

/// The events up to where LCM's own reader stops.
inline std::vector<LogEvent> events_of(const std::filesystem::path& path) {
  lcm::LogFile log(path.string(), "r");
  EXPECT_TRUE(log.good()) << path;
  std::vector<LogEvent> events;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    const auto* bytes = static_cast<const std::uint8_t*>(event->data);
    events.push_back(
        {event->eventnum, event->timestamp, event->channel, {bytes, bytes + event->datalen}});
  }
  return events;
}

}  // namespace wordgaze
