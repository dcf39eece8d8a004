#include "wordgaze/draw/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canvas.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::draw {
namespace {

/// Okabe and Ito's colors, which people with any color vision tell apart.
constexpr std::array<Rgb, 7> kSeriesColors{{{0, 114, 178},
                                            {213, 94, 0},
                                            {0, 158, 115},
                                            {204, 121, 167},
                                            {86, 180, 233},
                                            {230, 159, 0},
                                            {60, 60, 60}}};
constexpr Font kTitle{24, true}, kLabel{16, false}, kTick{14, false};
constexpr double kLeft = 92, kRight = 36, kTop = 84, kBottom = 72;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  bool empty() const { return !(low <= high); }
  /// At least a little wide, so that a constant has a place.
  Range widened() const {
    if (low < high) return *this;
    const double margin = low == 0 ? 1 : std::abs(low) * 0.1;
    return {low - margin, high + margin};
  }
};

void check(const Series& series) {
  const std::size_t size = series.x.size();
  require(series.y.size() == size, "line_plot: series '{}' has {} x and {} y", series.name, size,
          series.y.size());
  const bool band = !series.low.empty() || !series.high.empty();
  require(!band || (series.low.size() == size && series.high.size() == size),
          "line_plot: series '{}' has {} points and a band of {} and {}", series.name, size,
          series.low.size(), series.high.size());
}

class Drawing {
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot),
        canvas_(plot.width, plot.height),
        width_(plot.width - kLeft - kRight),
        height_(plot.height - kTop - kBottom) {
    for (const Series& series : plot.series) {
      check(series);
      x_.include(series.x);
      for (const auto* values : {&series.y, &series.low, &series.high}) y_.include(*values);
    }
    require(!x_.empty() && !y_.empty(), "line_plot: no finite point in '{}'", plot.title);
    x_ = x_.widened();
    y_ = y_.widened();
    if (plot.y_range) {
      y_ = {plot.y_range->first, plot.y_range->second};
    } else {
      const double margin = 0.04 * (y_.high - y_.low);
      y_ = {y_.low - margin, y_.high + margin};
    }
  }

  Image draw() {
    draw_axes();
    canvas_.clip(kLeft, kTop - 2, width_ + 2, height_ + 4);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw_band(plot_.series[i], color(i));
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw_line(plot_.series[i], color(i));
    canvas_.unclip();
    draw_legend();
    return canvas_.finished();
  }

 private:
  static Rgb color(std::size_t i) { return kSeriesColors[i % kSeriesColors.size()]; }
  Point at(double x, double y) const {
    return {kLeft + width_ * (x - x_.low) / (x_.high - x_.low),
            kTop + height_ * (y_.high - y) / (y_.high - y_.low)};
  }

  void draw_axes() {
    canvas_.text(kLeft, 40, plot_.title, kTitle);
    for (const Tick& tick : ticks(y_.low, y_.high, 6)) {
      const Point p = at(x_.low, tick.value);
      canvas_.line({p, {kLeft + width_, p.y}}, kFaint, 1);
      canvas_.text(kLeft - 10, p.y + 5, tick.text, kTick, kSoftInk, Align::right);
    }
    const double floor = kTop + height_;
    for (const Tick& tick : ticks(x_.low, x_.high, 8)) {
      const Point p = at(tick.value, y_.low);
      canvas_.line({{p.x, floor}, {p.x, floor + 5}}, kSoftInk, 1);
      canvas_.text(p.x, floor + 24, tick.text, kTick, kSoftInk, Align::center);
    }
    canvas_.line({{kLeft, floor}, {kLeft + width_, floor}}, kSoftInk, 1);
    canvas_.text(kLeft + width_ / 2, floor + 54, plot_.x_label, kLabel, kInk, Align::center);
    canvas_.upward_text(28, kTop + height_ / 2, plot_.y_label, kLabel);
  }

  void draw_band(const Series& series, Rgb color) {
    std::vector<Point> outline, lower;
    for (std::size_t i = 0; i < series.low.size(); ++i) {
      if (!std::isfinite(series.x[i] + series.low[i] + series.high[i])) continue;
      outline.push_back(at(series.x[i], series.high[i]));
      lower.push_back(at(series.x[i], series.low[i]));
    }
    outline.insert(outline.end(), lower.rbegin(), lower.rend());
    canvas_.area(outline, color, 0.18);
  }

  void draw_line(const Series& series, Rgb color) {
    std::vector<Point> points;
    const auto flush = [&] {
      if (points.size() == 1) points.push_back(points.front());  // a dot
      canvas_.line(points, color, 2.4);
      points.clear();
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i] + series.y[i])) {
        points.push_back(at(series.x[i], series.y[i]));
      } else {
        flush();
      }
    }
    flush();
  }

  /// In a row above the plot, from the right.
  void draw_legend() {
    double x = kLeft + width_;
    for (std::size_t i = plot_.series.size(); i-- > 0;) {
      x -= canvas_.text_width(plot_.series[i].name, kTick);
      canvas_.text(x, kTop - 16, plot_.series[i].name, kTick);
      canvas_.line({{x - 32, kTop - 21}, {x - 8, kTop - 21}}, color(i), 3);
      x -= 54;
    }
  }

  const Plot& plot_;
  Canvas canvas_;
  double width_, height_;  // of the area between the axes
  Range x_, y_;
};

}  // namespace

std::vector<Tick> ticks(double low, double high, int count) {
  const double rough = (high - low) / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double digit = rough / power;
  const double step = power * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);

  constexpr std::array<std::pair<double, const char*>, 4> units{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}}};
  const double largest = std::max(std::abs(low), std::abs(high));
  const auto& [unit, suffix] = *std::ranges::find_if(
      units, [&](const auto& u) { return largest >= u.first || u.first == 1; });
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step / unit) - 1e-9)));

  std::vector<Tick> marks;
  constexpr double kSlack = 1e-9;  // of a step: rounding must not lose a tick at the end
  for (double k = std::ceil(low / step - kSlack); k <= high / step + kSlack; ++k) {
    const double value = k * step;
    marks.push_back({value, k == 0 ? "0" : fmt::format("{:.{}f}{}", value / unit, digits, suffix)});
  }
  return marks;
}

Image line_plot(const Plot& plot) { return Drawing(plot).draw(); }

}  // namespace wordgaze::draw
