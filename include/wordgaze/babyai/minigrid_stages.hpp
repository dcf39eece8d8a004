#pragma once
#include <string_view>

#include "wordgaze/babyai/layout.hpp"

/// Stages that MiniGrid's own levels share.
namespace wordgaze::babyai::generators {

/// An empty grid with walls along its border; no agent yet.
void empty_grid(Layout& layout, int width, int height);
/// The same as large as the level's room.
void empty_grid(Layout& layout);

/// The agent at the top left, looking right.
void agent_in_corner(Layout& layout);
/// The goal at the bottom right.
void goal_in_corner(Layout& layout);

/// A new object in a cell.
grid::ObjectId put_new(Layout& layout, grid::Type type, grid::Color color, grid::Position p);
/// An unlocked door in a cell.
grid::ObjectId put_door(Layout& layout, grid::Color color, grid::Position p);

/// A mission of fixed text.
void ask(Layout& layout, std::string_view mission);

/// Appends words of fixed text to a mission.
void say(Sentence& mission, std::string_view text);

/// Appends color and type, "red ball", to a mission.
void append_name(Sentence& sentence, const grid::Object& object);

}  // namespace wordgaze::babyai::generators
