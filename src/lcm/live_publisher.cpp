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
#include "wordgaze/core/require.hpp"

namespace wordgaze::lcm_io {
namespace {

/// The multicast group of a "udpm://group:port?ttl=n" URL; LCM's default where none is written.
std::string multicast_group(std::string_view url) {
  url.remove_prefix(std::string_view("udpm://").size());
  const std::string_view group = url.substr(0, url.find_first_of(":?"));
  return std::string(group.empty() ? "239.255.76.67" : group);
}

/// Whether packets to the group have a way out. LCM itself would only print and return nothing.
bool has_route(const std::string& group) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  if (::inet_pton(AF_INET, group.c_str(), &address.sin_addr) != 1) return true;  // LCM will refuse
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

  void publish_all() {
    while (const std::optional<Message> message = queue.pop()) {
      const auto size = static_cast<unsigned>(message->bytes.size());
      if (lcm->publish(message->channel, message->bytes.data(), size) != 0) ++dropped;
    }
  }

  std::string problem;
  std::atomic<std::int64_t> dropped = 0;
  BoundedQueue<Message> queue;
  std::unique_ptr<lcm::LCM> lcm;  // none while there is a problem
  std::thread thread;
};

LivePublisher::LivePublisher(const std::string& url, Origin origin, int every,
                             std::size_t queue_capacity)
    : MessageObserver(std::move(origin), every), worker_(std::make_unique<Worker>(queue_capacity)) {
  if (url.starts_with("udpm://") && !has_route(multicast_group(url))) {
    worker_->problem = fmt::format(
        "nothing is published on {}: there is no route for multicast; add one with "
        "'ip route add 224.0.0.0/4 dev lo'",
        url);
    return;
  }
  worker_->lcm = std::make_unique<lcm::LCM>(url);
  require(worker_->lcm->good(),
          "cannot open the LCM URL '{}': expected udpm://[group[:port]][?ttl=n]", url);
  worker_->thread = std::thread([worker = worker_.get()] { worker->publish_all(); });
}

LivePublisher::~LivePublisher() = default;

const std::string& LivePublisher::problem() const { return worker_->problem; }

std::int64_t LivePublisher::dropped() const { return worker_->dropped; }

void LivePublisher::send(std::string_view channel, std::vector<std::uint8_t> bytes,
                         std::int64_t /*utime*/) {
  const bool queued =
      worker_->lcm && worker_->queue.try_push({std::string(channel), std::move(bytes)});
  if (!queued) ++worker_->dropped;
}

}  // namespace wordgaze::lcm_io
