#include "event_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>

#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/lcm/origin.hpp"

namespace wordgaze::lcm_io {
namespace {

constexpr std::array<std::uint8_t, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kHead = 28;
constexpr std::uint32_t kLongestChannel = 63;            // LCM_MAX_CHANNEL_NAME_LENGTH
constexpr std::uint64_t kMostData = 0x7FFF'FFFF;         // an int32_t
constexpr std::uint64_t kMostNumber = 1ull << 62;        // more is no count
constexpr std::uint64_t kMostOfOurs = 16 * 1024 * 1024;  // bytes; our messages are far smaller
constexpr std::size_t kWindow = 64 * 1024;

std::uint64_t number_at(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8 | bytes[i];
  return number;
}

void put(std::vector<std::uint8_t>& bytes, std::uint64_t number, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

template <class Message>
bool decodes(std::span<const std::uint8_t> bytes) {
  try {
    detail::check(bytes, static_cast<const Message*>(nullptr));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Whether these are the bytes of a message that we send on this channel.
bool is_ours(std::string_view channel, std::span<const std::uint8_t> bytes) {
  return (channel == kEpisodeBeginChannel && decodes<episode_begin_t>(bytes)) ||
         (channel == kWorldChannel && decodes<world_t>(bytes)) ||
         (channel == kProgressChannel && decodes<progress_t>(bytes)) ||
         (channel == kStepChannel && decodes<step_t>(bytes)) ||
         (channel == kEpisodeEndChannel && decodes<episode_end_t>(bytes)) ||
         (channel == kMetricsChannel && decodes<metrics_t>(bytes));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view cause,
                       std::string_view what = "write") {
  throw std::runtime_error(
      fmt::format("cannot {} the LCM log '{}': {}", what, path.string(), cause));
}

}  // namespace

EventLog::EventLog(const std::filesystem::path& path, Access access) : path_(path) {
  struct stat status {};
  if (access == Access::read) {
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) fail(path, last_error().message(), "read");
    if (::fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode)) {
      ::close(fd_);
      fail(path, "it is not a file", "read");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  regular_ = ::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
  fd_ = ::open(path.c_str(), (regular_ ? O_RDWR | O_CREAT : O_WRONLY) | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(path, last_error().message());
  if (!regular_) return;
  std::string_view cause;
  // Not every file system has locks: only a lock that another process holds is a reason to refuse.
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    cause = "another process is writing it; give another file";
  } else if (::fstat(fd_, &status) != 0) {
    cause = "its size cannot be read";
  }
  if (!cause.empty()) {
    ::close(fd_);
    fail(path, cause);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

EventLog::~EventLog() { ::close(fd_); }

/// Fills `bytes` from a place on; returns how many there are.
std::size_t EventLog::read(std::uint64_t place, std::span<std::uint8_t> bytes) const {
  if (place >= size_) return 0;
  const auto wanted = std::min<std::uint64_t>(bytes.size(), size_ - place);
  const bool inside = place >= window_at_ && place + wanted <= window_at_ + window_.size();
  if (!inside) {
    window_.resize(std::max<std::size_t>(kWindow, wanted));
    const ssize_t count = ::pread(fd_, window_.data(), window_.size(), static_cast<off_t>(place));
    window_.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    window_at_ = place;
  }
  const auto from = static_cast<std::size_t>(place - window_at_);
  const std::size_t count = std::min<std::size_t>(wanted, window_.size() - from);
  std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(from), count, bytes.begin());
  return count;
}

/// What the lengths at a place say, if the file holds as much; what follows is not looked at.
std::optional<EventLog::Event> EventLog::framed_event_at(std::uint64_t place) const {
  std::array<std::uint8_t, kHead + kLongestChannel> head;
  const std::size_t count = read(place, head);
  if (count < kHead || !std::equal(kSync.begin(), kSync.end(), head.begin())) return std::nullopt;
  const std::uint64_t number = number_at(&head[4], 8), utime = number_at(&head[12], 8);
  const std::uint64_t channel = number_at(&head[20], 4), data = number_at(&head[24], 4);
  if (number >= kMostNumber || channel == 0 || channel > kLongestChannel || data > kMostData ||
      size_ - place < kHead + channel + data || count < kHead + channel) {
    return std::nullopt;
  }
  const auto* name = reinterpret_cast<const char*>(head.data() + kHead);
  const std::uint64_t data_at = place + kHead + channel;
  return Event{static_cast<std::int64_t>(number), static_cast<std::int64_t>(utime),
               std::string(name, channel), data_at, data_at + data};
}

/// Whether an event may begin here: the end, or the sync word as far as the file goes.
bool EventLog::continues_at(std::uint64_t place) const {
  std::array<std::uint8_t, kSync.size()> word;
  const std::size_t count = read(place, word);
  return std::equal(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(count), kSync.begin());
}

std::optional<EventLog::Event> EventLog::event_at(std::uint64_t place) const {
  auto event = framed_event_at(place);
  if (!event || continues_at(event->end)) return event;
  const bool ours = event->data_size() <= kMostOfOurs && is_ours(event->channel, data(*event));
  return ours ? event : std::nullopt;
}

std::vector<std::uint8_t> EventLog::data(const Event& event) const {
  std::vector<std::uint8_t> bytes(event.data_size());
  bytes.resize(read(event.data_at, bytes));
  return bytes;
}

bool EventLog::has_event_behind(std::uint64_t place) const {
  std::array<std::uint8_t, kWindow> part;
  for (++place; place < size_;) {
    const std::size_t count = read(place, part);
    if (count < kHead) return false;
    const auto end = part.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::search(part.begin(), end, kSync.begin(), kSync.end());
    if (found == end) {
      place += count - (kSync.size() - 1);
      continue;
    }
    place += static_cast<std::uint64_t>(found - part.begin());
    const auto event = framed_event_at(place);
    if (event && continues_at(event->end)) return true;
    ++place;
  }
  return false;
}

bool EventLog::is_torn_at(std::uint64_t place) const {
  std::array<std::uint8_t, kHead> head;
  const std::size_t count = read(place, head);
  const auto known = std::min(count, kSync.size());
  if (!std::equal(kSync.begin(), kSync.begin() + static_cast<std::ptrdiff_t>(known),
                  head.begin())) {
    return false;
  }
  if (count < kHead) return true;
  const std::uint64_t channel = number_at(&head[20], 4), data = number_at(&head[24], 4);
  return number_at(&head[4], 8) < kMostNumber && channel > 0 && channel <= kLongestChannel &&
         data <= kMostData && size_ - place < kHead + channel + data;
}

void EventLog::cut(std::uint64_t place) {
  if (!regular_) return;
  window_.clear();
  if (::ftruncate(fd_, static_cast<off_t>(place)) != 0) fail(path_, last_error().message());
  size_ = place;
}

std::error_code EventLog::append(std::int64_t number, std::int64_t utime, std::string_view channel,
                                 std::span<const std::uint8_t> data) {
  bytes_.assign(kSync.begin(), kSync.end());
  put(bytes_, static_cast<std::uint64_t>(number), 8);
  put(bytes_, static_cast<std::uint64_t>(utime), 8);
  put(bytes_, channel.size(), 4);
  put(bytes_, data.size(), 4);
  bytes_.insert(bytes_.end(), channel.begin(), channel.end());
  bytes_.insert(bytes_.end(), data.begin(), data.end());
  for (std::size_t done = 0; done < bytes_.size();) {
    const auto* from = bytes_.data() + done;
    const std::size_t rest = bytes_.size() - done;
    const ssize_t count = regular_ ? ::pwrite(fd_, from, rest, static_cast<off_t>(size_ + done))
                                   : ::write(fd_, from, rest);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const std::error_code error = last_error();
      // Best effort: without it the log ends in a torn event, which a later opening cuts.
      [[maybe_unused]] const int taken_back =
          regular_ ? ::ftruncate(fd_, static_cast<off_t>(size_)) : 0;
      return error;
    }
    done += static_cast<std::size_t>(count);
  }
  if (regular_) size_ += bytes_.size();
  return {};
}

}  // namespace wordgaze::lcm_io
