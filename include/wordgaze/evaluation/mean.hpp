#pragma once
#include <cstdint>
#include <limits>

namespace wordgaze::evaluation {

/// A mean that grows; of true and false it is a rate.
struct Mean {
  double sum = 0;
  std::int64_t count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  void operator+=(const Mean& o) {
    sum += o.sum;
    count += o.count;
  }
  /// NaN while nothing was added.
  double value() const {
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace wordgaze::evaluation
