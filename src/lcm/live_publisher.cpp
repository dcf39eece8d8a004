#include "wordgaze/lcm/live_publisher.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <lcm/lcm-cpp.hpp>
#include <thread>
#include <utility>

#include "bounded_queue.hpp"
#include "url.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::lcm_io {
namespace {

/// Whether packets to the group have a way out. LCM itself would only print and return nothing.
bool has_route(const std::string& group) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  ::inet_pton(AF_INET, group.c_str(), &address.sin_addr);
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool unreachable =
      ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
      errno == ENETUNREACH;
  ::close(fd);
  return !unreachable;
}

}  // namespace

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
  if (!has_route(multicast_group(url))) {
    worker_->problem = fmt::format(
        "nothing is published on {}: there is no route for multicast; add one with "
        "'ip route add 224.0.0.0/4 dev lo'",
        url);
    return;
  }
  const auto bus = std::make_shared<lcm::LCM>(url);
  require(bus->good(), "cannot open the LCM URL '{}'; LCM says why on standard error", url);
  worker_->start([bus](const std::string& channel, std::span<const std::uint8_t> bytes) {
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
