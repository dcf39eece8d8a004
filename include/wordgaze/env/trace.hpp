#pragma once
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "wordgaze/env/policy.hpp"
#include "wordgaze/env/random_policy.hpp"

/// Traces of episodes as JSON Lines, one record per reset and step: the reference's worlds on
/// paper. docs/formats.md describes the records.
namespace wordgaze::env {

/// What a replay found.
struct ReplayReport {
  int envs = 0;  ///< distinct ids
  std::int64_t resets = 0, steps = 0, mismatches = 0;
};

/// Replays traces and compares every record with ours; after a mismatch it goes on at the next
/// seeded reset. The first mismatches are described in `details`. Throws std::runtime_error with
/// the line number for text that is not a trace, std::invalid_argument for an unknown id.
ReplayReport replay(std::istream& trace, std::ostream& details);

struct RecordOptions {
  std::vector<std::string> ids;
  std::int64_t first_seed = 0, end_seed = 4;  ///< [first, end): one stream of episodes for each
  int steps = 100;                            ///< per seed
  std::uint64_t policy_seed = 0;
  std::string policy_name = "random";
  PolicyMaker policy = make_policy<RandomPolicy>;
  bool done_actions = false;  ///< the reference's done mode on ids that have none of their own
};

/// Writes the traces of a policy.
void record(const RecordOptions& options, std::ostream& trace);

}  // namespace wordgaze::env
