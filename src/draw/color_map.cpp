#include "color_map.hpp"

#include <algorithm>
#include <cmath>

namespace wordgaze::draw {

Rgb magma(double value) {
  constexpr std::array<Rgb, 17> colors{{{0, 0, 4},
                                        {10, 8, 34},
                                        {29, 17, 71},
                                        {54, 16, 107},
                                        {81, 18, 124},
                                        {106, 28, 129},
                                        {131, 38, 129},
                                        {156, 46, 127},
                                        {183, 55, 121},
                                        {208, 65, 111},
                                        {231, 82, 99},
                                        {245, 107, 92},
                                        {252, 137, 97},
                                        {254, 167, 114},
                                        {254, 196, 136},
                                        {253, 226, 163},
                                        {252, 253, 191}}};
  const double place = (value > 0 ? std::min(value, 1.0) : 0.0) * (colors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  const double part = place - static_cast<double>(below);
  Rgb mixed{};
  for (std::size_t c = 0; c < mixed.size(); ++c) {
    mixed[c] = static_cast<std::uint8_t>(
        std::lround((1 - part) * colors[below][c] + part * colors[below + 1][c]));
  }
  return mixed;
}

double place_on_bar(double share) { return share > 0 ? std::sqrt(std::min(share, 1.0)) : 0; }

Rgb heat(double share) { return magma(place_on_bar(share)); }

}  // namespace wordgaze::draw
