#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace wordgaze::lcm_io {

/// A file in LCM's log format, read and appended to. Events follow each other without gaps, all
/// numbers big-endian:
///
///     4  sync word, ED A1 DA 01
///     8  number of the event      8  time stamp, microseconds since 1970
///     4  length of the channel    4  length of the data
///        channel                     data
///
/// lcm::LogFile does not serve: it appends behind whatever stands there, numbers from 0 on at each
/// opening, and leaves half an event behind on a full disk. No length in the file is believed
/// before the file is seen to hold as much.
class EventLog {
 public:
  /// Opens or makes the file, with its content as it is, and keeps other processes from writing it.
  /// Throws std::runtime_error that names the file and the cause.
  explicit EventLog(const std::filesystem::path& path) : EventLog(path, Access::write) {}
  /// To look into a file that may be written by another process meanwhile: what it holds now.
  static EventLog to_read(const std::filesystem::path& path) { return {path, Access::read}; }
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  struct Event {
    std::int64_t number, utime;
    std::string channel;
    std::uint64_t data_at, end;  ///< places in the file; the data ends with the event

    std::uint64_t data_size() const { return end - data_at; }
  };

  /// The whole event that begins at a place of the file, if one does. A reader of LCM takes no
  /// event that is followed by anything but an event; here one of ours may be, if its data decodes.
  std::optional<Event> event_at(std::uint64_t place) const;
  std::vector<std::uint8_t> data(const Event& event) const;

  /// Whether a whole event, followed by another or by the end, begins behind `place`.
  bool has_event_behind(std::uint64_t place) const;
  /// Whether what stands from `place` to the end is the first part of an event, or nothing.
  bool is_torn_at(std::uint64_t place) const;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< bytes; 0 for a pipe or a device

  /// Drops everything from `place` on. Throws std::runtime_error.
  void cut(std::uint64_t place);

  /// Puts an event at the end; it is in the file when this returns. What cannot be written whole
  /// (a full disk) is taken back, and the cause returned.
  std::error_code append(std::int64_t number, std::int64_t utime, std::string_view channel,
                         std::span<const std::uint8_t> data);

 private:
  enum class Access : std::uint8_t { read, write };
  EventLog(const std::filesystem::path& path, Access access);

  std::size_t read(std::uint64_t place, std::span<std::uint8_t> bytes) const;
  std::optional<Event> framed_event_at(std::uint64_t place) const;
  bool continues_at(std::uint64_t place) const;

  std::filesystem::path path_;
  int fd_ = -1;
  bool regular_ = true;  // else a pipe or a device, which is only written
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> bytes_;  // of the event being written
  // The part of the file that was read last: events are small and stand side by side.
  mutable std::vector<std::uint8_t> window_;
  mutable std::uint64_t window_at_ = 0;
};

}  // namespace wordgaze::lcm_io
