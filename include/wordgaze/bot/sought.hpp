#pragma once
#include <vector>

#include "wordgaze/babyai/meaning.hpp"
#include "wordgaze/babyai/verifier.hpp"

namespace wordgaze::bot {

/// The objects that a phrase means, and where they stand as far as is known. The bot takes the k-th
/// place for that of the k-th object. Both lists are in the order of the grid, column by column:
/// objects as they stood at first, places as they are occupied now. So, as in the reference, it may
/// take one object for another when one of several has been moved.
struct Sought {
  std::vector<grid::ObjectId> objects;
  std::vector<grid::Position> places;

  bool operator==(const Sought&) const = default;
};

/// The objects of a phrase of the instruction, where the verifier last saw them.
Sought objects_meant(const grid::World& world, const babyai::Verifier& verifier,
                     const babyai::Meaning& meaning, grid::ObjectSet meant,
                     const babyai::Description& description);

/// All keys of a color that stand in the world, seen or not: the bot of the reference knows.
Sought keys(const grid::World& world, grid::Color color);

}  // namespace wordgaze::bot
