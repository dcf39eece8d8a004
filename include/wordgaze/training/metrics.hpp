#pragma once
#include <string>
#include <utility>
#include <vector>

namespace wordgaze::training {

/// One row of metrics.csv: an update. Rates and means of episodes run over the last 1000 that the
/// curriculum did not help; NaN where there is nothing to say.
struct Metrics {
  double frames = 0;        ///< environment steps so far
  double seconds = 0;       ///< wall time so far
  double success_rate = 0;  ///< episodes that end in success
  double mean_return = 0;
  double mean_length = 0;
  double policy_loss = 0, value_loss = 0;
  double mask_loss = 0;      ///< L_TA
  double entropy = 0;        ///< of the policy, nats
  double kl = 0;             ///< between the rollout's policy and the updated one
  double clip_fraction = 0;  ///< frames beyond the clip
  double gradient_norm = 0;  ///< before clipping
  double learning_rate = 0, task_learning_rate = 0;
  double hit = 0;     ///< the brightest cell of M is the target, of frames with a target in view
  double hit_12 = 0;  ///< the same with 12 objects, as last probed
  double success_go_to = 0, success_pickup = 0;
  double done_wrong = 0;  ///< episodes that a wrong declaration ended
  double truncated = 0;   ///< episodes that ran out of time
  double go_to_share = 0;
  double skipped = 0;  ///< minibatches without a finite gradient
  /// What losses report that are not the library's, with their names; behind the other columns.
  std::vector<std::pair<std::string, double>> others{};

  std::vector<std::string> columns() const;
  std::vector<double> values() const;
};

}  // namespace wordgaze::training
