#pragma once
#include <concepts>
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
template <std::floating_point S>
class BasicLoss {
 public:
  virtual ~BasicLoss() = default;

  /// What it reports: columns of metrics.csv, as means over the frames of an update.
  virtual std::span<const std::string_view> reports() const = 0;

  /// Adds `scale` times the gradient of the sum over all frames of a batch to `gradient`, and what
  /// it reports, summed over the frames, to `sums`. Called by several workers at the same time.
  virtual void add(const BasicBatch<S>& batch, const model::Outputs<S>& outputs, const Rates& rates,
                   S scale, model::Outputs<S>& gradient, std::span<double> sums) const = 0;
};
using Loss = BasicLoss<float>;

template <std::floating_point S>
using BasicLosses = std::vector<std::unique_ptr<BasicLoss<S>>>;
using Losses = BasicLosses<float>;

/// The terms that a configuration asks for: the clipped objective with value loss and entropy
/// bonus, and L_TA where there is a Task Attention Module.
template <std::floating_point S = float>
BasicLosses<S> make_losses(const model::Config& model, const PpoConfig& ppo);
extern template BasicLosses<float> make_losses(const model::Config&, const PpoConfig&);
extern template BasicLosses<double> make_losses(const model::Config&, const PpoConfig&);

}  // namespace wordgaze::training
