#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "wordgaze/episode_begin_t.hpp"
#include "wordgaze/episode_end_t.hpp"
#include "wordgaze/metrics_t.hpp"
#include "wordgaze/policy_reply_t.hpp"
#include "wordgaze/policy_request_t.hpp"
#include "wordgaze/progress_t.hpp"
#include "wordgaze/step_t.hpp"
#include "wordgaze/world_t.hpp"

/// Decoding of bytes from a log or the network. The decoder that lcm-gen writes believes every
/// count in the bytes and crashes on a hostile one: only messages that were walked through first
/// reach it.
namespace wordgaze::lcm_io {

namespace detail {
/// Throws std::runtime_error unless the bytes are one whole message of the type.
void check(std::span<const std::uint8_t> bytes, const episode_begin_t* type);
void check(std::span<const std::uint8_t> bytes, const world_t* type);
void check(std::span<const std::uint8_t> bytes, const progress_t* type);
void check(std::span<const std::uint8_t> bytes, const step_t* type);
void check(std::span<const std::uint8_t> bytes, const episode_end_t* type);
void check(std::span<const std::uint8_t> bytes, const metrics_t* type);
void check(std::span<const std::uint8_t> bytes, const policy_reply_t* type);
}  // namespace detail

/// Throws std::runtime_error when the bytes are of another type, truncated, or claim to hold more
/// than they do.
template <class Message>
Message decode(std::span<const std::uint8_t> bytes) {
  Message message{};
  detail::check(bytes, &message);
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) {
    throw std::runtime_error(std::string("cannot decode ") + Message::getTypeName());
  }
  return message;
}

/// Of a request, -1 for the number of completions becomes 0: both say that none are given.
template <>
policy_request_t decode<policy_request_t>(std::span<const std::uint8_t> bytes);

}  // namespace wordgaze::lcm_io
