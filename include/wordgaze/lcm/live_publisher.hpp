#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/lcm/message_observer.hpp"

namespace wordgaze::lcm_io {

/// Publishes live from a thread of its own. The caller never waits: messages go through a bounded
/// queue, and what does not fit is dropped and counted. (UDP may lose more on the way; for a record
/// without loss use LogWriter.)
class LivePublisher final : public MessageObserver {
 public:
  static constexpr std::size_t kQueueCapacity = 1024;  ///< messages

  /// Publishes every `every`-th episode and all metrics on an LCM URL, as "udpm://" or
  /// "udpm://239.255.76.67:7667?ttl=0". Throws std::invalid_argument for what is not such a URL; of
  /// LCM's transports only udpm never waits. A machine without a multicast route is no error: see
  /// problem().
  LivePublisher(const std::string& url, Origin origin, int every = 1,
                std::size_t queue_capacity = kQueueCapacity);

  /// Sends a message; false when it could not.
  using Publish = std::function<bool(const std::string& channel, std::span<const std::uint8_t>)>;
  /// The same over another transport; `publish` is called from the publisher's thread.
  LivePublisher(Publish publish, Origin origin, int every = 1,
                std::size_t queue_capacity = kQueueCapacity);
  /// Sends what is queued, then ends. Waits as long as the transport does, which UDP never does.
  ~LivePublisher() override;

  /// Why nothing is published and which command helps; empty when all is well. To be told once.
  const std::string& problem() const;

  /// Messages that were not handed to the transport.
  std::int64_t dropped() const;

 private:
  void send(std::string_view channel, std::vector<std::uint8_t> bytes, std::int64_t utime) override;

  struct Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace wordgaze::lcm_io
