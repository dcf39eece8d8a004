#pragma once
#include "wordgaze/core/rng.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::training {

/// Makes a room seem larger than it is, in the agent's view alone: behind the cells that are
/// `near`, ahead and to both sides, it inserts `gap` cells of floor, and what lies beyond moves
/// away by as many, perhaps out of sight. So a small room shows what large ones do: no wall in
/// view, the target at its far edge, nothing of interest without a walk.
struct Stretch {
  /// One axis of the view, by distances from the agent. The default leaves it as it is.
  struct Axis {
    int near = grid::kViewSize, gap = 0;
    bool inserts(int distance) const { return distance > near && distance <= near + gap; }
    /// The true distance of what is shown here; that of the last near cell where floor is inserted.
    int source(int distance) const;
    bool operator==(const Axis&) const = default;
  };
  Axis ahead, aside;

  static Stretch draw(core::Rng& rng);

  /// Changes the image of a view.
  void apply(grid::ImageView image) const;

  bool operator==(const Stretch&) const = default;
};

}  // namespace wordgaze::training
