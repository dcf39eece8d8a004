#pragma once
#include <cstdint>
#include <iosfwd>

namespace wordgaze::trace {

/// What a replay found.
struct ReplayReport {
  int envs = 0;  ///< distinct ids
  std::int64_t resets = 0, steps = 0, mismatches = 0;
};

/// Replays traces and compares every record with ours; after a mismatch it goes on at the next
/// seeded reset. The first mismatches are described in `details`. Throws std::runtime_error with
/// the line number for text that is not a trace, and where there was nothing to compare;
/// std::invalid_argument for an unknown id.
ReplayReport replay(std::istream& in, std::ostream& details);

}  // namespace wordgaze::trace
