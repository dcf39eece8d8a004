#pragma once
#include <array>
#include <cstdint>
#include <string_view>

/// What a cell can hold. The integers are MiniGrid's: they are what the agent sees.
namespace wordgaze::grid {

enum class Type : std::uint8_t {
  unseen,
  empty,
  wall,
  floor,
  door,
  key,
  ball,
  box,
  goal,
  lava,
  agent
};
enum class Color : std::uint8_t { red, green, blue, purple, yellow, grey };
enum class DoorState : std::uint8_t { open, closed, locked };

inline constexpr std::array<std::string_view, 11> kTypeNames{
    "unseen", "empty", "wall", "floor", "door", "key", "ball", "box", "goal", "lava", "agent"};
inline constexpr std::array<std::string_view, 6> kColorNames{"red",    "green",  "blue",
                                                             "purple", "yellow", "grey"};

/// What missions are about: keys, balls, boxes and doors.
constexpr bool is_object(Type type) { return type >= Type::door && type <= Type::box; }

constexpr std::string_view name(Type type) { return kTypeNames[static_cast<int>(type)]; }
constexpr std::string_view name(Color color) { return kColorNames[static_cast<int>(color)]; }

/// Colors in the order in which the generators draw them: alphabetical, unlike the integers.
inline constexpr std::array kColorsToDraw{Color::blue,   Color::green, Color::grey,
                                          Color::purple, Color::red,   Color::yellow};

}  // namespace wordgaze::grid
