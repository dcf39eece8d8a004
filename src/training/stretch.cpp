#include "wordgaze/training/stretch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "wordgaze/grid/cell.hpp"

namespace wordgaze::training {
namespace {

constexpr int kMiddle = grid::kViewSize / 2;  ///< column of the agent
constexpr int kBack = grid::kViewSize - 1;    ///< row of the agent

}  // namespace

int Stretch::Axis::source(int distance) const {
  return distance <= near ? distance : std::max(near, distance - gap);
}

Stretch Stretch::draw(core::Rng& rng) {
  Stretch s;
  s.ahead.near = 1 + rng.below(kBack - 1);
  s.ahead.gap = rng.below(kBack);
  s.aside.near = rng.below(kMiddle);
  s.aside.gap = rng.below(kMiddle + 1);
  return s;
}

void Stretch::apply(grid::ImageView image) const {
  if (*this == Stretch{}) return;
  using grid::Type;
  using Cell = std::array<std::uint8_t, 3>;
  constexpr Cell kUnseen{static_cast<std::uint8_t>(Type::unseen), 0, 0};
  constexpr Cell kEmpty{static_cast<std::uint8_t>(Type::empty), 0, 0};
  std::array<std::uint8_t, grid::kImageBytes> truth;
  std::copy(image.begin(), image.end(), truth.begin());
  for (int x = 0; x < grid::kViewSize; ++x) {
    const int side = std::abs(x - kMiddle);
    const int from_x = kMiddle + (x < kMiddle ? -1 : 1) * aside.source(side);
    for (int y = 0; y < grid::kViewSize; ++y) {
      const int distance = kBack - y;
      const int from_y = kBack - ahead.source(distance);
      const auto* from = &truth[static_cast<std::size_t>(3 * (grid::kViewSize * from_x + from_y))];
      Cell cell{from[0], from[1], from[2]};
      if (aside.inserts(side) || ahead.inserts(distance)) {
        // Floor goes on where floor was; behind a wall there is nothing to see.
        const auto type = static_cast<Type>(cell[0]);
        cell = type == Type::unseen || type == Type::wall ? kUnseen : kEmpty;
      }
      std::copy(cell.begin(), cell.end(), image.begin() + 3 * (grid::kViewSize * x + y));
    }
  }
}

}  // namespace wordgaze::training
