#pragma once
#include <cstdint>
#include <limits>

namespace wordgaze::explain {

/// A mean that grows; of true and false it is a rate.
struct Mean {
  double sum = 0;
  std::int64_t count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  /// NaN while nothing was added.
  double value() const {
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace wordgaze::explain
