#pragma once
#include <concepts>

#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/model/config.hpp"

namespace wordgaze::model {

/// What a network says of N frames; and, in the same type, the gradient of a loss with respect to
/// it.
template <std::floating_point S>
struct Outputs {
  Matrix<S> logits;  ///< [7, N] of the policy
  Matrix<S> values;  ///< [1, N]
  /// [task_words, N] alpha, in (0, 1); without rows where there is no Task Attention Module. In a
  /// gradient: with respect to the logit of alpha, where the gradient of a cross-entropy is tame.
  Matrix<S> mask;

  void resize(const Config& config, Index frames) {
    logits.resize(grid::kActions, frames);
    values.resize(1, frames);
    mask.resize(config.task_attention ? mask_words(config) : 0, frames);
  }
  void set_zero() {
    for (auto* m : {&logits, &values, &mask}) m->setZero();
  }
};

}  // namespace wordgaze::model
