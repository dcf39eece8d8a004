#include "wordgaze/training/loss.hpp"

#include <array>

#include "wordgaze/training/mask_loss.hpp"
#include "wordgaze/training/ppo_loss.hpp"

namespace wordgaze::training {
namespace {

template <std::floating_point S>
class PpoTerm final : public BasicLoss<S> {
 public:
  explicit PpoTerm(const PpoConfig& ppo) : ppo_(ppo) {}

  std::span<const std::string_view> reports() const override { return kReports; }

  void add(const BasicBatch<S>& batch, const model::Outputs<S>& outputs, const Rates& rates,
           S scale, model::Outputs<S>& gradient, std::span<double> sums) const override {
    const PpoLoss<S> loss{.clip = static_cast<S>(ppo_.clip),
                          .value_coefficient = static_cast<S>(ppo_.value_coefficient),
                          .entropy_coefficient = static_cast<S>(rates.entropy_coefficient)};
    typename PpoLoss<S>::Sums sum;
    const auto actions = static_cast<std::size_t>(batch.actions);
    for (Index n = 0; n < outputs.logits.cols(); ++n) {
      const auto i = static_cast<std::size_t>(n);
      loss.add({.action = batch.action[i],
                .old_log_prob = batch.log_prob[i],
                .advantage = batch.advantage[i],
                .value_target = batch.value_target[i]},
               {outputs.logits.col(n).data(), actions}, outputs.values(0, n), scale,
               {gradient.logits.col(n).data(), actions}, gradient.values(0, n), sum);
    }
    const std::array numbers{sum.policy, sum.value, sum.entropy, sum.divergence, sum.clipped};
    for (std::size_t k = 0; k < numbers.size(); ++k) sums[k] += numbers[k];
  }

 private:
  static constexpr std::array<std::string_view, 5> kReports{"policy_loss", "value_loss", "entropy",
                                                            "kl", "clip_fraction"};
  PpoConfig ppo_;
};

template <std::floating_point S>
class MaskTerm final : public BasicLoss<S> {
 public:
  explicit MaskTerm(double coefficient) : coefficient_(coefficient) {}

  std::span<const std::string_view> reports() const override { return kReports; }

  void add(const BasicBatch<S>& batch, const model::Outputs<S>& outputs, const Rates&, S scale,
           model::Outputs<S>& gradient, std::span<double> sums) const override {
    for (Index n = 0; n < outputs.mask.cols(); ++n) {
      sums[0] += mask_loss(batch.mission(n), batch.bright[static_cast<std::size_t>(n)],
                           outputs.mask.col(n), scale * coefficient_, gradient.mask.col(n));
    }
  }

 private:
  static constexpr std::array<std::string_view, 1> kReports{"mask_loss"};
  double coefficient_;
};

}  // namespace

template <std::floating_point S>
BasicLosses<S> make_losses(const model::Config& model, const PpoConfig& ppo) {
  BasicLosses<S> losses;
  losses.push_back(std::make_unique<PpoTerm<S>>(ppo));
  if (model.task_attention) losses.push_back(std::make_unique<MaskTerm<S>>(ppo.mask_coefficient));
  return losses;
}
template BasicLosses<float> make_losses(const model::Config&, const PpoConfig&);
template BasicLosses<double> make_losses(const model::Config&, const PpoConfig&);

}  // namespace wordgaze::training
