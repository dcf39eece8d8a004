#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace wordgaze::page {

/// Texts in their order, for readers that each go at their own pace: the last so many are kept, and
/// who is slower than that misses some.
class EventStream {
 public:
  explicit EventStream(std::size_t most) : most_(most) {}

  void add(std::string event) {
    {
      const std::scoped_lock lock(mutex_);
      events_.push_back(std::move(event));
      if (events_.size() > most_) {
        events_.pop_front();
        ++first_;
      }
    }
    arrived_.notify_all();
  }

  /// The event that a reader comes to at `place`, which goes on behind it; nothing within a second,
  /// so that the reader can be seen to be there still, or after close().
  std::optional<std::string> next(std::uint64_t& place) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, std::chrono::seconds(1),
                      [&] { return closed_ || place < first_ + events_.size(); });
    if (closed_) return std::nullopt;
    if (place < first_) place = first_;
    if (place >= first_ + events_.size()) return std::nullopt;
    return events_[static_cast<std::size_t>(place++ - first_)];
  }

  void close() {
    {
      const std::scoped_lock lock(mutex_);
      closed_ = true;
    }
    arrived_.notify_all();
  }
  bool closed() const {
    const std::scoped_lock lock(mutex_);
    return closed_;
  }

 private:
  std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<std::string> events_;
  std::uint64_t first_ = 0;  // number of the first that is kept
  bool closed_ = false;
};

}  // namespace wordgaze::page
