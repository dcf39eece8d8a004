#include "wordgaze/evaluation/transparency.hpp"

#include <algorithm>

namespace wordgaze::evaluation {
namespace {

/// A list of 0/1 as bits.
std::uint16_t bits(std::span<const std::uint8_t> flags) {
  std::uint16_t set = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) set |= static_cast<std::uint16_t>(1u << i);
  }
  return set;
}

bool target_in_view(const Roles& roles) {
  return std::find(roles.begin(), roles.end(), Role::target) != roles.end();
}

}  // namespace

Transparency::Transparency(const model::Config& config, model::MaskTruth mask_truth)
    : config_(config), mask_truth_(mask_truth), rng_(0x7a4e) {}

void Transparency::on_decision(const DecisionContext& context) {
  const auto& environment = context.environment;
  ++decisions_;
  const auto& image = context.observation.image;
  const Roles roles = roles_of(image, environment.progress());
  const auto saliency = context.policy.saliency(context.lane, context.decision.action);
  add_map(context, {saliency.gradient.data(), grid::kViewCells}, 0, roles, gradient_);
  add_map(context, {saliency.product.data(), grid::kViewCells}, 0, roles, product_);
  if (!has_gaze()) return;
  context.policy.attention(context.lane, record_);
  add_map(context, record_.gaze, static_cast<double>(record_.nowhere), roles, gaze_);
  add_filter(roles);
  words_.add(record_.maps, environment.sentence(), image);
  weights_.add(record_.weights, environment.sentence());
  if (has_mask()) add_mask(context);
}

void Transparency::add_map(const DecisionContext& context, std::span<const float> map,
                           double on_nowhere, const Roles& roles, MapReport& report) {
  const bool in_view = target_in_view(roles);
  report.pointing.add(map, roles);
  (in_view ? report.mass_in_view : report.mass_out_of_view).add(map, roles, on_nowhere);
  const Shifts moved = shifts(context, map, roles, rng_);
  report.faithfulness.add(moved);
  if (in_view) report.faithfulness_in_view.add(moved);
}

void Transparency::add_filter(const Roles& roles) {
  const auto floor = static_cast<float>(config_.gaze_floor);
  const float height = std::max(1 - floor, 1e-6f);
  std::transform(record_.filter.begin(), record_.filter.end(), added_.begin(),
                 [&](float s) { return std::max(s - floor, 0.0f) / height; });
  if (target_in_view(roles)) {
    filter_.add(record_.filter, roles);
    spotlight_.add(added_, roles);
  } else {
    glow_.add(record_.gaze, roles);
    spotlight_glow_.add(added_, roles);
  }
}

void Transparency::add_mask(const DecisionContext& context) {
  const auto& environment = context.environment;
  const babyai::Progress progress = environment.progress();
  const bool agrees = mask_.add(record_.mask, environment.sentence(),
                                model::bright_sub_tasks(mask_truth_, progress));
  mask_delay_.add(static_cast<std::size_t>(context.lane), environment.step_count() == 0,
                  bits(progress.completion()), agrees);
}

}  // namespace wordgaze::evaluation
