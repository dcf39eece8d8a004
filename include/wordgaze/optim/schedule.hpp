#pragma once
#include <algorithm>

namespace wordgaze::optim {

/// From `from` to `to` over `length` units of progress, then constant.
constexpr double linear(double from, double to, double progress, double length) {
  const double part = length > 0 ? std::clamp(progress / length, 0.0, 1.0) : 1.0;
  return from + (to - from) * part;
}

}  // namespace wordgaze::optim
