#pragma once
#include <string_view>

namespace wordgaze::babyai {

/// Throws std::invalid_argument unless a level of one's own may have this id: no built-in one's,
/// and none that programs could not take in lists.
void check_own_id(std::string_view id);

}  // namespace wordgaze::babyai
