#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/draw/image.hpp"

namespace wordgaze::draw {

/// A line through (x, y); points that are not finite interrupt it.
struct Series {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low{}, high{};  ///< edges of a band around the line, or both empty
};

/// A line plot, as of learning curves.
struct Plot {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::optional<std::pair<double, double>> y_range{};  ///< else what the series need
  int width = 1200, height = 720;
};

/// Throws std::invalid_argument when the arrays of a series differ in length or there is no finite
/// point.
Image line_plot(const Plot& plot);

/// Round numbers from `low` to `high`, about `count` of them: 1, 2 or 5 times a power of ten apart.
std::vector<double> ticks(double low, double high, int count);
/// "1.5M", "20k", "0.25": as many digits as neighbors `step` apart need.
std::string tick_text(double value, double step);

}  // namespace wordgaze::draw
