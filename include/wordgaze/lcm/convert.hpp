#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/episode_begin_t.hpp"
#include "wordgaze/episode_end_t.hpp"
#include "wordgaze/lcm/origin.hpp"
#include "wordgaze/metrics_t.hpp"
#include "wordgaze/policy/observer.hpp"
#include "wordgaze/policy/server.hpp"
#include "wordgaze/policy_reply_t.hpp"
#include "wordgaze/policy_request_t.hpp"
#include "wordgaze/progress_t.hpp"
#include "wordgaze/step_t.hpp"
#include "wordgaze/world_t.hpp"

/// Records of training and evaluation as LCM messages (lcmtypes/). `utime` is the time of sending
/// in microseconds since 1970. A message keeps its counts next to its arrays, and the encoder that
/// lcm-gen writes trusts them: these functions are the only place where messages are built, and
/// they throw std::invalid_argument when sizes or ranges are wrong.
namespace wordgaze::lcm_io {

episode_begin_t to_message(const policy::EpisodeBegin& record, const Origin& origin,
                           std::int64_t utime);
world_t to_world_message(const policy::SceneRecord& record, std::int64_t utime);
progress_t to_progress_message(const policy::SceneRecord& record, std::int64_t utime);
step_t to_message(const policy::StepRecord& record, std::int64_t utime);
episode_end_t to_message(const policy::EpisodeEnd& record, std::int64_t utime);
metrics_t to_message(const policy::UpdateRecord& record, const Origin& origin, std::int64_t utime);
policy_request_t to_message(const policy::Request& request, std::int64_t utime);
policy_reply_t to_message(const policy::Reply& reply, std::int64_t utime);

/// The other way round, of a message that decode() has read.
policy::Request to_request(const policy_request_t& message);

/// The bytes of a message as they go into a log or over the network.
template <class Message>
std::vector<std::uint8_t> encode(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace wordgaze::lcm_io
