#pragma once
#include <optional>

#include "wordgaze/bot/reach.hpp"

namespace wordgaze::bot {

/// The closest cell to put something down: where it does not stand in the way, if there is one, and
/// without moving other things, if possible. Not the agent's cell, and not the one that something
/// else is meant for.
std::optional<grid::Position> find_drop_place(const grid::World& world, const Seen& seen,
                                              const Reach& reach,
                                              std::optional<grid::Position> reserved = {});

}  // namespace wordgaze::bot
