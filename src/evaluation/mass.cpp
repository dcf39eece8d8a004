#include "wordgaze/evaluation/mass.hpp"

#include <numeric>

namespace wordgaze::evaluation {

void Mass::add(std::span<const float> map, const Roles& roles) {
  const double total = std::accumulate(map.begin(), map.end(), 0.0);
  if (!(total > 0)) return;
  std::array<double, kRoles> mass{}, cells{};
  for (std::size_t c = 0; c < roles.size(); ++c) {
    mass[static_cast<std::size_t>(roles[c])] += static_cast<double>(map[c]) / total;
    cells[static_cast<std::size_t>(roles[c])] += 1.0 / grid::kViewCells;
  }
  for (std::size_t r = 0; r < kRoles; ++r) {
    share[r].add(mass[r]);
    even[r].add(cells[r]);
  }
}

}  // namespace wordgaze::evaluation
