#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "wordgaze/core/types.hpp"
#include "wordgaze/nn/sequence.hpp"

namespace wordgaze::training {

/// Generalized advantage estimation; equations (P1)-(P2) in docs/math.md.
///
/// A truncated episode is not an end of the task: its reward must already hold discount * V(final
/// observation). `ended` is 1 where an episode ended, for either reason, with that step.
///
/// shapes   reward, value, ended, advantage: steps * batch, time-major; next_value: batch, the
/// values
///          of what follows the last step
inline void estimate_advantages(nn::SequenceShape shape, std::span<const float> reward,
                                std::span<const float> value, std::span<const std::uint8_t> ended,
                                std::span<const float> next_value, float discount, float lambda,
                                std::span<float> advantage) {
  for (Index b = 0; b < shape.batch; ++b) {
    float following_value = next_value[static_cast<std::size_t>(b)], following_advantage = 0;
    for (Index t = shape.steps - 1; t >= 0; --t) {
      const auto c = static_cast<std::size_t>(shape.column(t, b));
      const float alive = ended[c] ? 0.0f : 1.0f;
      const float surprise = reward[c] + discount * alive * following_value - value[c];
      following_advantage = surprise + discount * lambda * alive * following_advantage;
      following_value = value[c];
      advantage[c] = following_advantage;
    }
  }
}

}  // namespace wordgaze::training
