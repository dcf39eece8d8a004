#include "lcm/url.hpp"

#include <gtest/gtest.h>

#include "support/messages.hpp"

namespace wordgaze::lcm_io {
namespace {

TEST(Url, NamesTheMulticastGroup) {
  for (const char* usual : {"udpm://", "udpm://?ttl=1", "udpm://?recv_buf_size=65536&ttl=0"}) {
    EXPECT_EQ(multicast_group(usual), "239.255.76.67") << usual;
  }
  EXPECT_EQ(multicast_group("udpm://224.0.0.0"), "224.0.0.0");
  EXPECT_EQ(multicast_group("udpm://239.255.255.255:65535?ttl=255"), "239.255.255.255");
  EXPECT_EQ(multicast_group("udpm://239.1.2.3:1"), "239.1.2.3");
}

std::string refusal(const std::string& url) {
  const auto message = message_of<std::invalid_argument>([&] { multicast_group(url); });
  EXPECT_TRUE(contains(message, "'" + url + "'"));
  return message;
}

TEST(Url, RefusesOtherTransports) {
  for (const char* url : {"", "udpm", "udpm:/", "UDPM://", " udpm://", "http://example.org",
                          "memq://", "file://x", "file://x?mode=w", "mpudpm://", "239.255.76.67"}) {
    EXPECT_TRUE(contains(refusal(url), "expected udpm://")) << url;
  }
  for (const char* url : {"tcpq://", "tcpq://localhost:7700"}) {
    EXPECT_TRUE(contains(refusal(url), "tcpq is not offered")) << url;
  }
}

TEST(Url, RefusesAddressesThatAreNoMulticastGroup) {
  for (const char* place : {"127.0.0.1", "127.0.0.1:7667", "192.168.1.20:7667?ttl=1",
                            "223.255.255.255", "240.0.0.0", "localhost", "239.255.76", ":7667",
                            "239.255.76.67.1", "ff02::1", "[ff02::1]:7667", "/239.255.76.67"}) {
    EXPECT_TRUE(contains(refusal(std::string("udpm://") + place), "224.0.0.0 to 239.255.255.255"))
        << place;
  }
}

TEST(Url, RefusesPortsAndParametersThatAreNone) {
  for (const char* port : {":", ":0", ":65536", ":-1", ":7667x", ":+7667", ": 7667", ":1:2"}) {
    EXPECT_TRUE(contains(refusal(std::string("udpm://239.255.76.67") + port), "from 1 to 65535"))
        << port;
  }
  for (const char* ttl : {"abc", "", "-1", "256", "1.5", "1 ", "99999999999999999999", "0x1"}) {
    EXPECT_TRUE(contains(refusal(std::string("udpm://?ttl=") + ttl), "expected a ttl")) << ttl;
  }
  for (const char* parameter : {"", "tll=1", "TTL=1", "mode=w", "ttl=1&", "ttl=1&x=2", "&ttl=1"}) {
    EXPECT_TRUE(contains(refusal(std::string("udpm://?") + parameter), "unknown parameter"))
        << parameter;
  }
  EXPECT_TRUE(contains(refusal("udpm://?ttl"), "expected a ttl"));
  EXPECT_TRUE(contains(refusal("udpm://?ttl=1?ttl=2"), "expected a ttl"));
  EXPECT_TRUE(contains(refusal("udpm://?ttl=1&ttl=2"), "twice"));
  EXPECT_TRUE(contains(refusal("udpm://?recv_buf_size=0"), "recv_buf_size in bytes"));
}

}  // namespace
}  // namespace wordgaze::lcm_io
