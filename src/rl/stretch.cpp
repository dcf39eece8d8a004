#include "wordgaze/rl/stretch.hpp"

#include <algorithm>
#include <cstdlib>

namespace wordgaze::rl {
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

void Stretch::apply(const model::CellAlphabet& alphabet,
                    Eigen::Ref<Vector<std::uint8_t>> cells) const {
  if (*this == Stretch{}) return;
  constexpr auto kUnseen = static_cast<std::uint8_t>(grid::Type::unseen);
  constexpr auto kEmpty = static_cast<std::uint8_t>(grid::Type::empty);
  constexpr auto kWall = static_cast<std::uint8_t>(grid::Type::wall);
  const auto unseen = static_cast<std::uint8_t>(alphabet.find({kUnseen, 0, 0}));
  const auto empty = static_cast<std::uint8_t>(alphabet.find({kEmpty, 0, 0}));
  const Eigen::Matrix<std::uint8_t, grid::kViewCells, 1> truth = cells;
  for (int x = 0; x < grid::kViewSize; ++x) {
    const int side = std::abs(x - kMiddle);
    const int from_x = kMiddle + (x < kMiddle ? -1 : 1) * aside.source(side);
    for (int y = 0; y < grid::kViewSize; ++y) {
      const int distance = kBack - y;
      const int from_y = kBack - ahead.source(distance);
      auto& cell = cells(grid::kViewSize * x + y);
      cell = truth(grid::kViewSize * from_x + from_y);
      if (!aside.inserts(side) && !ahead.inserts(distance)) continue;
      // Floor goes on where floor was; behind a wall there is nothing to see.
      const auto type = alphabet[cell].type;
      cell = type == kUnseen || type == kWall ? unseen : empty;
    }
  }
}

}  // namespace wordgaze::rl
