#include "wordgaze/explain/transparency.hpp"

#include <algorithm>

namespace wordgaze::explain {
namespace {

/// A list of 0/1 as bits.
std::uint8_t bits(std::span<const std::uint8_t> flags) {
  std::uint8_t set = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) set |= static_cast<std::uint8_t>(1u << i);
  }
  return set;
}

bool target_in_view(const Roles& roles) {
  return std::find(roles.begin(), roles.end(), Role::target) != roles.end();
}

}  // namespace

Transparency::Transparency(const rl::Agent& agent, const rl::Agent::Params& params,
                           model::MaskTruth mask_truth)
    : what_if_(agent, params), mask_truth_(mask_truth), rng_(0x7a4e) {}

void Transparency::on_decision(const rl::Decision& decision) {
  const auto& environment = decision.environment;
  const auto& agent = what_if_.agent();
  ++decisions_;
  rl::look(agent, decision.actor, decision.lane, environment, sight_);
  const Roles roles = roles_of(sight_.image, environment.progress());
  const auto saliency = what_if_.saliency(decision);
  add_map(decision, {saliency.gradient.data(), grid::kViewCells}, roles, gradient_);
  add_map(decision, {saliency.product.data(), grid::kViewCells}, roles, product_);
  if (!has_gaze()) return;
  add_map(decision, sight_.gaze, roles, gaze_);
  if (target_in_view(roles)) filter_.add(sight_.filter, roles);
  words_.add(sight_.maps, environment.sentence(), sight_.image);
  weights_.add(sight_.weights, environment.sentence());
  if (has_mask()) add_mask(decision);
}

void Transparency::add_map(const rl::Decision& decision, std::span<const float> map,
                           const Roles& roles, MapReport& report) {
  const bool in_view = target_in_view(roles);
  report.pointing.add(map, roles);
  (in_view ? report.mass_in_view : report.mass_out_of_view).add(map, roles);
  const Shifts moved = shifts(what_if_, decision, map, roles, rng_);
  report.faithfulness.add(moved);
  if (in_view) report.faithfulness_in_view.add(moved);
}

void Transparency::add_mask(const rl::Decision& decision) {
  const auto& environment = decision.environment;
  const babyai::Progress progress = environment.progress();
  const bool agrees = mask_.add(sight_.mask, environment.sentence(),
                                model::bright_sub_tasks(mask_truth_, progress));
  mask_delay_.add(static_cast<std::size_t>(decision.lane), environment.step_count() == 0,
                  bits(progress.completion()), agrees);
}

}  // namespace wordgaze::explain
