#pragma once
#include <string_view>

#include "wordgaze/babyai/progress.hpp"
#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/draw/image.hpp"
#include "wordgaze/grid/world.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::draw {

/// What a step's record does not say: the world and the progress as they were before the action,
/// and the mission.
struct Scene {
  const grid::World& world;
  const babyai::Sentence& sentence;
  const babyai::Progress& progress;  ///< says what is a target: evaluation::Role
  std::string_view env_id;
};

/// One decision in a picture of 1200 pixels width: the world with the agent's view highlighted, the
/// view as the agent sees it, the attention map M over it, the policy; then, word by word, where
/// the word looks (A), how much it counts (w) and what the task mask leaves of it (alpha, when a
/// mask dims some word). Targets have a frame. Without text-visual attention the maps are left out.
///
/// All scales are fixed, from 0 to 1: two pictures can be compared. A map that sums to less than 1
/// has its rest nowhere, which is shown as one more cell: M says "not in view" when most of it is
/// there. Only a word's map tells whether the agent can say so, for of M a task mask takes as well.
///
/// Throws std::invalid_argument when the record's arrays do not fit the sentence.
Image decision_figure(const policy::StepRecord& step, const Scene& scene);

}  // namespace wordgaze::draw
