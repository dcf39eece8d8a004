#pragma once
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "wordgaze/env/policy.hpp"
#include "wordgaze/env/random_policy.hpp"

/// Traces of episodes as JSON Lines, one record per reset and step: the reference's worlds on
/// paper. docs/formats.md describes the records.
namespace wordgaze::trace {

struct RecordOptions {
  std::vector<std::string> ids;
  std::int64_t first_seed = 0, end_seed = 4;  ///< [first, end): one stream of episodes for each
  int steps = 100;                            ///< per seed
  std::uint64_t policy_seed = 0;
  std::string policy_name = "random";
  /// Who acts: the bot, a trained agent, anything that is asked before each action.
  env::PolicyMaker policy = env::make_policy<env::RandomPolicy>;
  bool done_actions = false;  ///< the reference's done mode on ids that have none of their own
};

/// Writes the traces of a policy.
void record(const RecordOptions& options, std::ostream& out);

}  // namespace wordgaze::trace
