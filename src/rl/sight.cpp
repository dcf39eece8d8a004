#include "wordgaze/rl/sight.hpp"

namespace wordgaze::rl {

void look(const Agent& agent, const Actor& actor, int lane, const env::Environment& environment,
          Sight& sight) {
  environment.observe(sight.image);
  for (auto* values : {&sight.weights, &sight.mask, &sight.maps, &sight.gaze, &sight.filter})
    values->clear();
  if (!agent.config.attention) return;
  const auto length = environment.sentence().length;
  const auto& attention = actor.cache().attention;
  const auto kind = [&](Index cell) { return agent.kind(actor.frames().cells, cell, lane); };
  for (Index i = 0; i < length; ++i) {
    sight.weights.push_back(attention.weights(i, lane));
    sight.mask.push_back(actor.cache().alpha(i, lane));
    for (Index c = 0; c < grid::kViewCells; ++c) {
      sight.maps.push_back(attention.maps(kind(c), attention.map(lane, i)));
    }
  }
  for (Index c = 0; c < grid::kViewCells; ++c) {
    sight.gaze.push_back(attention.gaze(kind(c), lane));
    sight.filter.push_back(attention.scale(kind(c), lane));
  }
}

}  // namespace wordgaze::rl
