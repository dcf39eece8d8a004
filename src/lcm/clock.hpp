#pragma once
#include <chrono>
#include <cstdint>

namespace wordgaze::lcm_io {

/// The time of sending that messages carry: microseconds since 1970-01-01 UTC.
inline std::int64_t now_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace wordgaze::lcm_io
