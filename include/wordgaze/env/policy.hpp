#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {

/// Who acts in one stream of episodes; asked before each action.
using Policy = std::function<grid::Action(const Environment&)>;

/// Makes the policy for the stream of an id and a seed; the third argument varies it.
using PolicyMaker = std::function<Policy(std::string_view, std::uint64_t, std::uint64_t)>;

/// The maker of policies of one type.
template <class Type>
Policy make_policy(std::string_view id, std::uint64_t seed, std::uint64_t policy_seed) {
  return Type(id, seed, policy_seed);
}

}  // namespace wordgaze::env
