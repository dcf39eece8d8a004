#include "url.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <vector>

#include "wordgaze/core/require.hpp"

namespace wordgaze::lcm_io {
namespace {

constexpr std::string_view kUdpm = "udpm://";
constexpr std::string_view kUsualGroup = "239.255.76.67";  // LCM's

/// Digits and nothing else, in [least, most].
bool is_number(std::string_view text, std::uint32_t least, std::uint32_t most) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && number >= least &&
         number <= most;
}

bool is_multicast(std::string_view text) {
  in_addr address{};
  return ::inet_pton(AF_INET, std::string(text).c_str(), &address) == 1 &&
         IN_MULTICAST(ntohl(address.s_addr));
}

/// Takes the part before the separator off the front of a text, or all of it.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t size = text.find(separator);
  const std::string_view part = text.substr(0, size);
  text = size == text.npos ? std::string_view{} : text.substr(size + 1);
  return part;
}

}  // namespace

std::string multicast_group(std::string_view url) {
  require(
      !url.starts_with("tcpq://"),
      "the LCM URL '{}': tcpq is not offered, for its sender waits for its server and complains "
      "of each message without one; give udpm://[group[:port]][?ttl=n], or write a log",
      url);
  require(url.starts_with(kUdpm), "the LCM URL '{}': expected udpm://[group[:port]][?ttl=n]", url);
  std::string_view rest = url.substr(kUdpm.size());
  const bool has_parameters = rest.find('?') != rest.npos;
  std::string_view place = take(rest, '?');
  const bool has_port = place.find(':') != place.npos;
  const bool usual = place.empty();
  const std::string_view group = take(place, ':');
  require(usual || is_multicast(group),
          "the LCM URL '{}': udpm needs a multicast group, an address from 224.0.0.0 to "
          "239.255.255.255; came '{}' (udpm:// alone is LCM's usual group, {})",
          url, group, kUsualGroup);
  require(!has_port || is_number(place, 1, 65'535),
          "the LCM URL '{}': expected a port from 1 to 65535; came '{}'", url, place);
  for (std::vector<std::string_view> seen; has_parameters;) {
    const bool last = rest.find('&') == rest.npos;
    std::string_view value = take(rest, '&');
    const std::string_view name = take(value, '=');
    require(name == "ttl" || name == "recv_buf_size",
            "the LCM URL '{}': unknown parameter '{}'; expected ttl=n or recv_buf_size=n", url,
            name);
    for (const auto earlier : seen) {
      require(earlier != name, "the LCM URL '{}': {} stands there twice", url, name);
    }
    seen.push_back(name);
    require(name != "ttl" || is_number(value, 0, 255),
            "the LCM URL '{}': expected a ttl from 0 (this machine) to 255; came '{}'", url, value);
    require(
        name != "recv_buf_size" || is_number(value, 1, std::numeric_limits<std::int32_t>::max()),
        "the LCM URL '{}': expected recv_buf_size in bytes, from 1 on; came '{}'", url, value);
    if (last) break;
  }
  return std::string(usual ? kUsualGroup : group);
}

}  // namespace wordgaze::lcm_io
