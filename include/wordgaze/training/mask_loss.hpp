#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/model/task_mask.hpp"

namespace wordgaze::training {

/// The mask loss L_TA of one frame: the mean over the words of the mission of the binary
/// cross-entropy between alpha and the true mask, 0 without words; equation (P7) in docs/math.md.
/// Returns the loss and adds `scale` times its gradient to dlogits (+=), that of the logits of
/// alpha.
template <class Alpha, class Gradient>
double mask_loss(const babyai::Sentence& sentence, std::uint16_t bright, const Alpha& alpha,
                 double scale, Gradient&& dlogits) {
  using S = typename std::remove_cvref_t<Gradient>::Scalar;
  if (sentence.length == 0) return 0;
  double loss = 0;
  for (Index i = 0; i < sentence.length; ++i) {
    const bool truth = model::is_bright(sentence.sub_task_of[static_cast<std::size_t>(i)], bright);
    const auto a = static_cast<double>(alpha(i));
    loss -= std::log(std::max(truth ? a : 1 - a, 1e-12));
    dlogits(i) += static_cast<S>(scale * (a - (truth ? 1.0 : 0.0)) / sentence.length);
  }
  return loss / sentence.length;
}

}  // namespace wordgaze::training
