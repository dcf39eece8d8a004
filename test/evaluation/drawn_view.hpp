#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/observation.hpp"

/// Views with known answers.
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

}  // namespace wordgaze::test
