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

struct Tick {
  double value;
  std::string text;
};
/// About `count` round numbers from `low` to `high`, 1, 2 or 5 times a power of ten apart, with as
/// many digits as it takes: "0.25", "20k", "1.5M".
std::vector<Tick> ticks(double low, double high, int count);

}  // namespace wordgaze::draw
