#include "wordgaze/lcm/policy_service.hpp"

#include <cerrno>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "bus.hpp"
#include "clock.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/lcm/origin.hpp"

namespace wordgaze::lcm_io {
namespace {

/// Of requests that wait while one is answered: LCM's own 30 are soon full.
constexpr int kQueueCapacity = 4096;

std::shared_ptr<lcm::LCM> open(const std::string& url) {
  const std::string missing = missing_route(url);
  if (!missing.empty()) {
    throw std::runtime_error(formatted("nothing can be heard on {}: {}", url, missing));
  }
  return open_bus(url);
}

}  // namespace

PolicyService::PolicyService(const std::string& url, policy::Server& server)
    : PolicyService(open(url), server) {}

PolicyService::PolicyService(std::shared_ptr<lcm::LCM> bus, policy::Server& server)
    : bus_(std::move(bus)), server_(&server) {
  // A function: LCM's call of a member function trips over g++ 12's undefined-behavior sanitizer.
  using Hear = void (*)(const lcm::ReceiveBuffer*, const std::string&, PolicyService*);
  const Hear on_message = [](const lcm::ReceiveBuffer* received, const std::string&,
                             PolicyService* it) {
    it->hear({static_cast<const std::uint8_t*>(received->data), received->data_size});
  };
  subscription_ = bus_->subscribeFunction(std::string(kPolicyRequestChannel), on_message, this);
  if (subscription_ == nullptr) throw std::runtime_error("LCM: cannot subscribe");
  subscription_->setQueueCapacity(kQueueCapacity);
}

PolicyService::~PolicyService() { bus_->unsubscribe(subscription_); }

void PolicyService::serve(std::chrono::milliseconds at_most) {
  errno = 0;
  if (bus_->handleTimeout(static_cast<int>(at_most.count())) >= 0 || errno == EINTR) return;
  throw std::runtime_error(formatted("LCM: nothing can be received any more: {}",
                                     std::generic_category().message(errno)));
}

/// Called by LCM's C code, which no exception may pass through.
void PolicyService::hear(std::span<const std::uint8_t> bytes) noexcept {
  try {
    const std::optional<policy::Request> request = read(bytes);
    if (!request) return;
    const auto reply = encode(to_message(server_->answer(*request), now_utime()));
    const std::string channel(kPolicyReplyChannel);
    const auto size = static_cast<unsigned>(reply.size());
    if (bus_->publish(channel, reply.data(), size) != 0) ++counts_.unsent;
  } catch (...) {
    ++counts_.unsent;
  }
}

std::optional<policy::Request> PolicyService::read(std::span<const std::uint8_t> bytes) {
  try {
    if (bytes.size() > kLongestRequest) {
      throw std::runtime_error(
          formatted("not a valid policy_request_t: it has {} bytes", bytes.size()));
    }
    return to_request(decode<policy_request_t>(bytes));
  } catch (const std::runtime_error& error) {
    ++counts_.foreign;
    complaint_ = error.what();
    return std::nullopt;
  }
}

}  // namespace wordgaze::lcm_io
