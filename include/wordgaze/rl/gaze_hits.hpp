#pragma once
#include "wordgaze/rl/actor.hpp"

namespace wordgaze::rl {

/// How often the brightest cell of M is a target that is in view: the earliest sign of whether an
/// agent grounds its words. A target is an object of a sub-task whose turn it is.
struct GazeHits {
  std::int64_t seen = 0, hit = 0;

  /// NaN while no target was in view.
  double rate() const {
    return seen > 0 ? static_cast<double>(hit) / static_cast<double>(seen)
                    : std::numeric_limits<double>::quiet_NaN();
  }
  void operator+=(const GazeHits& o) {
    seen += o.seen;
    hit += o.hit;
  }
  /// Adds a decision of one lane.
  void add(const Agent& agent, const Actor& actor, int lane, const env::Environment& env) {
    if (!agent.config.attention) return;
    const auto& attention = actor.cache().attention;
    const babyai::Progress progress = env.progress();
    const auto turn = progress.enabled();
    bool in_view = false, brightest = false;
    for (std::size_t i = 0; i < turn.size(); ++i) {
      const auto& object = progress.object(i);
      if (!turn[i] || !object.type || !object.color) continue;
      const int code = agent.alphabet.find(
          {static_cast<std::uint8_t>(*object.type), static_cast<std::uint8_t>(*object.color), 0});
      const auto& cells = actor.frames().cells;
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        if (cells(cell, lane) != code) continue;
        in_view = true;
        brightest = brightest || attention.peak(lane) == agent.kind(cells, cell, lane);
      }
    }
    seen += in_view;
    hit += brightest;
  }
};

}  // namespace wordgaze::rl
