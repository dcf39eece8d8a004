#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/evaluation/faithfulness.hpp"
#include "wordgaze/evaluation/mask_quality.hpp"
#include "wordgaze/evaluation/mass.hpp"
#include "wordgaze/evaluation/pointing.hpp"
#include "wordgaze/evaluation/word_weights.hpp"
#include "wordgaze/model/task_mask.hpp"

namespace wordgaze::evaluation {

/// All that is measured of one map a decision, be it the agent's own or one made afterwards.
struct MapReport {
  Pointing pointing;
  Mass mass_in_view, mass_out_of_view;  ///< of a target
  Faithfulness faithfulness;            ///< over all decisions
  Faithfulness faithfulness_in_view;    ///< over those with a target in view
};

/// Transparency as numbers, over all decisions of an evaluation; docs/metrics.md defines each.
class Transparency final : public DecisionObserver {
 public:
  Transparency(const model::Config& config, model::MaskTruth mask_truth);

  void on_decision(const DecisionContext& context) override;

  std::int64_t decisions() const { return decisions_; }
  bool has_gaze() const { return config_.attention; }
  bool has_mask() const { return config_.task_attention; }

  /// Of M; empty for the baseline, as are filter(), words() and weights().
  const MapReport& gaze() const { return gaze_; }
  /// Of s(M), what the view is multiplied with, where a target is in view; and of s(M) - f, what
  /// the gaze adds to the floor.
  const Mass& filter() const { return filter_; }
  const Mass& spotlight() const { return spotlight_; }
  /// Of M, and of (s(M) - f) / (1 - f), where no target is in view.
  const Glow& glow() const { return glow_; }
  const Glow& spotlight_glow() const { return spotlight_glow_; }
  const MapReport& gradient() const { return gradient_; }
  const MapReport& gradient_times_input() const { return product_; }
  const WordPointing& words() const { return words_; }
  const WordWeights& weights() const { return weights_; }
  /// Empty without the Task Attention Module.
  const MaskQuality& mask() const { return mask_; }
  const MaskDelay& mask_delay() const { return mask_delay_; }

 private:
  void add_map(const DecisionContext& context, std::span<const float> map, double on_nowhere,
               const Roles& roles, MapReport& report);
  void add_filter(const Roles& roles);
  void add_mask(const DecisionContext& context);

  model::Config config_;
  model::MaskTruth mask_truth_;
  core::Rng rng_;
  policy::AttentionRecord record_;
  std::int64_t decisions_ = 0;
  MapReport gaze_, gradient_, product_;
  Mass filter_, spotlight_;
  Glow glow_, spotlight_glow_;
  std::array<float, grid::kViewCells> added_{};  // by the gaze to the floor, of one decision
  WordPointing words_;
  WordWeights weights_;
  MaskQuality mask_;
  MaskDelay mask_delay_;
};

}  // namespace wordgaze::evaluation
