#include "bus.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "url.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::lcm_io {

std::string missing_route(const std::string& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  ::inet_pton(AF_INET, multicast_group(url).c_str(), &address.sin_addr);
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool unreachable =
      ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
      errno == ENETUNREACH;
  ::close(fd);
  if (!unreachable) return "";
  return "there is no route for multicast; add one with 'ip route add 224.0.0.0/4 dev lo'";
}

std::shared_ptr<lcm::LCM> open_bus(const std::string& url) {
  auto bus = std::make_shared<lcm::LCM>(url);
  require(bus->good(), "cannot open the LCM URL '{}'; LCM says why on standard error", url);
  return bus;
}

}  // namespace wordgaze::lcm_io
