#include "wordgaze/evaluation/mask_quality.hpp"

#include "wordgaze/model/task_mask.hpp"

namespace wordgaze::evaluation {
namespace {

/// part / whole; NaN of nothing.
double ratio(std::int64_t part, std::int64_t whole) {
  return Mean{static_cast<double>(part), whole}.value();
}

}  // namespace

bool MaskQuality::add(std::span<const float> alpha, const babyai::Sentence& sentence,
                      std::uint16_t bright_sub_tasks) {
  bool agrees = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sentence.length); ++i) {
    const int sub_task = sentence.sub_task_of[i];
    if (sub_task < 0) continue;
    const bool truth = model::is_bright(sub_task, bright_sub_tasks), given = alpha[i] > 0.5f;
    (truth ? bright : dark).add(static_cast<double>(alpha[i]));
    ++(truth ? (given ? true_positive : false_negative) : (given ? false_positive : true_negative));
    agrees = agrees && truth == given;
  }
  return agrees;
}

double MaskQuality::precision() const {
  return ratio(true_positive, true_positive + false_positive);
}
double MaskQuality::recall() const { return ratio(true_positive, true_positive + false_negative); }
double MaskQuality::f1() const {
  return ratio(2 * true_positive, 2 * true_positive + false_positive + false_negative);
}

void MaskDelay::add(std::size_t index, bool begins, std::uint16_t completed, bool agrees) {
  if (index >= lanes_.size()) lanes_.resize(index + 1);
  Lane& lane = lanes_[index];
  if (begins) {
    lane = {.completed = completed};
  } else if (lane.completed != completed) {
    lane = {.completed = completed, .waiting = 0};
    ++changes_;
    at_once_ += agrees;
  } else if (lane.waiting >= 0) {
    ++lane.waiting;
  }
  if (lane.waiting >= 0 && agrees) {
    steps_.add(lane.waiting);
    lane.waiting = -1;
  }
}

}  // namespace wordgaze::evaluation
