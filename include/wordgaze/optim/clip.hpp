#pragma once

namespace wordgaze::optim {

/// What a gradient of this norm is multiplied with so that its norm is `limit` at most.
constexpr double clip_scale(double norm, double limit) { return norm > limit ? limit / norm : 1; }

}  // namespace wordgaze::optim
