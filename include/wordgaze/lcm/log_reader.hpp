#pragma once
#include <cstdint>
#include <filesystem>

#include "wordgaze/policy/observer.hpp"

namespace wordgaze::lcm_io {

/// What a log was found to hold.
struct LogSummary {
  std::int64_t events = 0;    ///< of any sender and channel
  std::int64_t messages = 0;  ///< ours
  std::int64_t refused = 0;   ///< on our channels, but not valid
  std::int64_t orphans = 0;   ///< of episodes whose beginning is not in the log
  std::int64_t episodes = 0;  ///< begun in it
  std::uint64_t unread = 0;   ///< bytes behind the last whole event: torn or damaged
};

/// Tells an observer what a log holds, in its order: a log of ours, or one that lcm-logger recorded
/// of a live run, with messages of others between ours. Any number in it may be wrong: what a
/// record promises (sizes, words of the vocabulary) is checked before it is told; the rest is left
/// out and counted. Throws std::runtime_error when the file cannot be read or holds no event.
LogSummary replay_log(const std::filesystem::path& path, policy::Observer& observer);

}  // namespace wordgaze::lcm_io
