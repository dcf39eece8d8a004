#pragma once
#include <string_view>

namespace wordgaze {

/// The version of these headers, by semantic versioning; CMakeLists.txt reads it here.
inline constexpr int kVersionMajor = 0, kVersionMinor = 1, kVersionPatch = 0;
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace wordgaze
