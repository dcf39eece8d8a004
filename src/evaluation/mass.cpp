#include "wordgaze/evaluation/mass.hpp"

#include <algorithm>
#include <numeric>

namespace wordgaze::evaluation {

void Mass::add(std::span<const float> map, const Roles& roles, double on_nowhere) {
  const double total = std::accumulate(map.begin(), map.end(), on_nowhere);
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
  nowhere.add(on_nowhere / total);
}

void Glow::add(std::span<const float> map, const Roles& roles) {
  float most = -1;
  for (std::size_t c = 0; c < roles.size(); ++c) {
    if (is_object(roles[c])) most = std::max(most, map[c]);
  }
  if (most < 0) return;
  brightest.add(static_cast<double>(most));
  over_half.add(most > 0.5f);
}

}  // namespace wordgaze::evaluation
