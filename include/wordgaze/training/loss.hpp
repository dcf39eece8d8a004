#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "wordgaze/model/outputs.hpp"
#include "wordgaze/training/batch.hpp"

namespace wordgaze::training {

/// What changes from update to update, as training goes on.
struct Rates {
  double learning_rate = 0, task_learning_rate = 0;
  double entropy_coefficient = 0;
};

/// A term of what is minimized. The learner holds a list of them and adds up their gradients.
class Loss {
 public:
  virtual ~Loss() = default;

  /// What it reports: columns of metrics.csv, as means over the frames of an update.
  virtual std::span<const std::string_view> reports() const = 0;

  /// Adds `scale` times the gradient of the sum over all frames of a batch to `gradient`, and what
  /// it reports, summed over the frames, to `sums`. Called by several workers at the same time.
  virtual void add(const Batch& batch, const model::Outputs<float>& outputs, const Rates& rates,
                   float scale, model::Outputs<float>& gradient, std::span<double> sums) const = 0;
};

using Losses = std::vector<std::unique_ptr<Loss>>;

/// The terms that a configuration asks for: the clipped objective with value loss and entropy
/// bonus, and L_TA where there is a Task Attention Module.
Losses make_losses(const model::Config& model, const PpoConfig& ppo);

}  // namespace wordgaze::training
