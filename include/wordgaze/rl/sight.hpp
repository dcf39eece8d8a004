#pragma once
#include <array>
#include <vector>

#include "wordgaze/rl/actor.hpp"

namespace wordgaze::rl {

/// What a lane sees and where it looks, over the 49 cells of the view: codes turned back into maps.
/// All but the image are empty for the baseline.
struct Sight {
  std::array<std::uint8_t, grid::kImageBytes> image{};
  std::vector<float> weights;  ///< w, one a word of the mission; sums to 1
  std::vector<float> mask;     ///< alpha, one a word; ones without the Task Attention Module
  std::vector<float> maps;     ///< A, 49 a word, row by row
  std::vector<float> gaze;     ///< M, 49
  std::vector<float> filter;   ///< s(M), 49: what the view is multiplied with
};

/// Overwrites `sight` with the last decision of a lane.
void look(const Agent& agent, const Actor& actor, int lane, const env::Environment& environment,
          Sight& sight);

}  // namespace wordgaze::rl
