#pragma once
#include <vector>

#include "wordgaze/babyai/meaning.hpp"
#include "wordgaze/babyai/verifier.hpp"

namespace wordgaze::bot {

/// An object, and where it stands.
struct Standing {
  grid::Position place;
  grid::ObjectId object;
};

/// The objects of a phrase of the instruction, where the verifier last saw them; in the order of
/// the grid, column by column.
std::vector<Standing> standing(const grid::World& world, const babyai::Verifier& verifier,
                               const babyai::Meaning& meaning, grid::ObjectSet meant,
                               const babyai::Description& description);

/// All keys of a color, in the same order; seen or not: the bot of the reference knows of them.
std::vector<Standing> standing_keys(const grid::World& world, grid::Color color);

/// What the bot looks for. The k-th place is taken for that of the k-th object, although only the
/// places are brought up to date. So, as in the reference, one object may be taken for another when
/// one of several has been moved.
struct Sought {
  std::vector<grid::ObjectId> objects;
  std::vector<grid::Position> places;

  explicit Sought(const std::vector<Standing>& all);
  void update_places(const std::vector<Standing>& all);
  bool operator==(const Sought&) const = default;
};

}  // namespace wordgaze::bot
