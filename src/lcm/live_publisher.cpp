#include "wordgaze/lcm/live_publisher.hpp"

#include <fmt/format.h>

#include <atomic>
#include <thread>
#include <utility>

#include "bounded_queue.hpp"
#include "bus.hpp"

namespace wordgaze::lcm_io {
struct LivePublisher::Worker {
  struct Message {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  explicit Worker(std::size_t queue_capacity) : queue(queue_capacity) {}
  ~Worker() {
    queue.close();
    if (thread.joinable()) thread.join();
  }

  void start(Publish function) {
    publish = std::move(function);
    thread = std::thread([this] { publish_all(); });
  }
  void publish_all() {
    while (const std::optional<Message> message = queue.pop()) {
      if (!publish(message->channel, message->bytes)) ++dropped;
    }
  }

  std::string problem;
  std::atomic<std::int64_t> dropped = 0;
  BoundedQueue<Message> queue;
  Publish publish;  // none while there is a problem
  std::thread thread;
};

LivePublisher::LivePublisher(Publish publish, Origin origin, int every, std::size_t queue_capacity)
    : MessageObserver(std::move(origin), every), worker_(std::make_unique<Worker>(queue_capacity)) {
  worker_->start(std::move(publish));
}

LivePublisher::LivePublisher(const std::string& url, Origin origin, int every,
                             std::size_t queue_capacity)
    : MessageObserver(std::move(origin), every), worker_(std::make_unique<Worker>(queue_capacity)) {
  if (const std::string missing = missing_route(url); !missing.empty()) {
    worker_->problem = fmt::format("nothing is published on {}: {}", url, missing);
    return;
  }
  worker_->start(
      [bus = open_bus(url)](const std::string& channel, std::span<const std::uint8_t> bytes) {
        return bus->publish(channel, bytes.data(), static_cast<unsigned>(bytes.size())) == 0;
      });
}

LivePublisher::~LivePublisher() = default;

const std::string& LivePublisher::problem() const { return worker_->problem; }

std::int64_t LivePublisher::dropped() const { return worker_->dropped; }

void LivePublisher::send(std::string_view channel, std::vector<std::uint8_t> bytes,
                         std::int64_t /*utime*/) {
  const bool queued =
      worker_->publish && worker_->queue.try_push({std::string(channel), std::move(bytes)});
  if (!queued) ++worker_->dropped;
}

}  // namespace wordgaze::lcm_io
