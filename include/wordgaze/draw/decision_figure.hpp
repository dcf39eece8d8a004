#pragma once
#include <string_view>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/draw/image.hpp"
#include "wordgaze/grid/world.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::draw {

/// What a step's record does not say: the world as it was before the action, and the mission.
struct Scene {
  const grid::World& world;
  const babyai::Sentence& sentence;
  std::string_view env_id;
};

/// One decision in a picture of 1200 pixels width: the world with the agent's view highlighted, the
/// view as the agent sees it, the attention map M over it, the policy; then, word by word, where
/// the word looks (A), how much it counts (w) and what the task mask leaves of it (alpha, when a
/// mask dims some word). Without text-visual attention the maps are left out. Throws
/// std::invalid_argument when the record's arrays do not fit the sentence.
Image decision_figure(const policy::StepRecord& step, const Scene& scene);

}  // namespace wordgaze::draw
