#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "wordgaze/policy/server.hpp"

namespace lcm {
class LCM;
class Subscription;
}  // namespace lcm

namespace wordgaze::lcm_io {

/// Answers policy_request_t by policy_reply_t, on kPolicyRequestChannel and kPolicyReplyChannel.
/// Bytes that are no request are counted and not answered: whom should one answer?
class PolicyService {
 public:
  static constexpr std::size_t kLongestRequest = 1 << 16;  ///< bytes

  struct Counts {
    std::int64_t foreign = 0;  ///< messages that are no requests
    std::int64_t unsent = 0;   ///< answers that could not be made (out of memory) or sent
  };

  /// On a URL of LCM's udpm, as "udpm://239.255.76.67:7667?ttl=0". Throws std::invalid_argument for
  /// what is none, std::runtime_error where there is no route for multicast, and says what helps.
  /// `server` must outlive the object.
  PolicyService(const std::string& url, policy::Server& server);
  /// On a bus of any kind.
  PolicyService(std::shared_ptr<lcm::LCM> bus, policy::Server& server);
  ~PolicyService();
  PolicyService(const PolicyService&) = delete;
  PolicyService& operator=(const PolicyService&) = delete;

  /// Waits for a message, at most so long, and answers it. Returns early for a signal. Throws
  /// std::runtime_error when nothing can be received any more.
  void serve(std::chrono::milliseconds at_most);

  const Counts& counts() const { return counts_; }
  /// Why the last message that was no request is none; empty while all were.
  const std::string& complaint() const { return complaint_; }

 private:
  void hear(std::span<const std::uint8_t> bytes) noexcept;
  std::optional<policy::Request> read(std::span<const std::uint8_t> bytes);

  std::shared_ptr<lcm::LCM> bus_;
  policy::Server* server_;
  lcm::Subscription* subscription_;
  Counts counts_;
  std::string complaint_;
};

}  // namespace wordgaze::lcm_io
