#pragma once
#include <vector>

#include "wordgaze/babyai/instruction.hpp"
#include "wordgaze/grid/observation.hpp"

/// Views and missions with known answers.
namespace wordgaze::test {

/// Empty cells, but for what was put there.
struct DrawnView {
  std::array<std::uint8_t, grid::kImageBytes> image{};

  DrawnView() {
    for (std::size_t c = 0; c < grid::kViewCells; ++c) put(c, grid::Type::empty);
  }
  void put(std::size_t cell, grid::Type type, grid::Color color = grid::Color::red) {
    image[3 * cell] = static_cast<std::uint8_t>(type);
    image[3 * cell + 1] = static_cast<std::uint8_t>(color);
  }
};

inline babyai::Instruction go_to(grid::Type type, grid::Color color) {
  return babyai::single({.object = {.type = type, .color = color}});
}

inline std::vector<std::uint8_t> flags(std::initializer_list<std::uint8_t> list) { return list; }

}  // namespace wordgaze::test
