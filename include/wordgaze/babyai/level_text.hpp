#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/setting.hpp"

/// Levels in words and text maps. (docs/own-level.md)
namespace wordgaze::babyai {

/// When a clause of a mission counts as done.
enum class Done : std::uint8_t { when_true, declared };
constexpr std::array<std::string_view, 2> names(Done) { return {"when_true", "declared"}; }

/// A level as one writes it, in C++ or in a file: a text map, or rooms.
///
///     babyai::register_level(babyai::level_of({.id = "Own-Key-v0",
///                                              .map = R"(
///     #########
///     #A..#..B#
///     #...D...#
///     #k..#...#
///     #########)",
///                                              .legend = "D = locked yellow door\nk = yellow key",
///                                              .missions = "pick up the ball"}));
///
/// A line of the map is a row, a letter a cell; the legend, one a line, has others or says more:
///
///     #        wall             . or space   nothing
///     A        the agent        > v < ^      the agent, and where it looks
///     D K B X  a closed door, a key, a ball, a box, each of a color that is drawn
///     G L      goal, lava
///
/// Objects, one or more a line, are placed at random: "blue key", "2 balls", "3 objects" (of drawn
/// types), "goal". Missions, one a line, of which one is drawn, are of the Baby language
/// (parser.hpp);
/// "{}" in place of an object is one of those that are there: "go to {}", "put {} next to {}".
/// Without missions the goal is to be reached.
struct LevelText {
  std::string id{};
  std::string map{}, legend{};
  int room_size = 8, columns = 1, rows = 1;
  std::string objects{};
  bool distinct = true;
  std::string missions{};
  Done done = Done::when_true;
  int max_steps = 0;
  bool see_through_walls = false;

  static constexpr auto settings() {
    using C = LevelText;
    return std::tuple{
        Setting{"id", &C::id, "name of the level; empty: that of its file"},
        Setting{"map", &C::map, "rows of letters, a letter a cell; empty: rooms"},
        Setting{"legend", &C::legend, "letters of the map, as 'k = yellow key', one a line"},
        Setting{"room_size", &C::room_size,
                "cells along a side of a room, walls included; without a map", 3, kMaxGridSide},
        Setting{"columns", &C::columns, "rooms side by side; without a map", 1, 25},
        Setting{"rows", &C::rows, "rooms one below the other; without a map", 1, 25},
        Setting{"objects", &C::objects, "placed at random, as '2 balls', one a line"},
        Setting{"distinct", &C::distinct,
                "no two keys, balls and boxes alike where they are drawn"},
        Setting{"missions", &C::missions,
                "one a line, of which one is drawn; empty: to reach the goal"},
        Setting{"done", &C::done,
                "when a clause counts: when it is true, or when action done "
                "declares it"},
        Setting{"max_steps", &C::max_steps, "of an episode; 0: by the size of the level", 0,
                1'000'000'000},
        Setting{"see_through_walls", &C::see_through_walls, "the agent sees all of its view"},
    };
  }
  bool operator==(const LevelText&) const = default;
};

/// The level that is meant. Throws std::invalid_argument that says which line, letter or mission is
/// wrong and what was expected; also where no world of the level can be drawn.
LevelSpec level_of(const LevelText& text);

/// Whether a level of data shows more than walls, keys, balls and boxes.
bool has_more(const LevelSpec& level);

}  // namespace wordgaze::babyai
