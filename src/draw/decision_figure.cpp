#include "wordgaze/draw/decision_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "canvas.hpp"
#include "color_map.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/draw/tile.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::draw {
namespace {

constexpr int kWidth = 1200, kMargin = 40;
constexpr int kContent = kWidth - 2 * kMargin;
constexpr int kPanel = 280;  // the three large squares
constexpr int kPanelGap = 32;
constexpr int kPanelCell = kPanel / grid::kViewSize;
constexpr int kWordCell = 16, kWordMap = kWordCell * grid::kViewSize;
constexpr int kWordsPerRow = 8;
constexpr double kWordPitch = static_cast<double>(kContent + 32) / kWordsPerRow;
constexpr Font kTitle{26, true}, kHeading{15, true}, kNote{14, false}, kSmall{12.5, false};

constexpr std::array<std::string_view, grid::kActions> kActionNames{
    "turn left", "turn right", "forward", "pick up", "drop", "toggle", "done"};

using ViewBytes = std::span<const std::uint8_t, grid::kImageBytes>;

std::vector<double> probabilities(std::span<const float> logits) {
  const double largest = *std::ranges::max_element(logits);
  std::vector<double> p(logits.begin(), logits.end());
  double sum = 0;
  for (double& v : p) sum += v = std::exp(v - largest);
  for (double& v : p) v /= sum;
  return p;
}

/// A part of the whole, from 0 to 1; 0 for what is not a number.
double fraction(double value, double whole) {
  const double part = value / whole;
  return part > 0 ? std::min(part, 1.0) : 0;
}

/// How much of a tile's pixel shows through the heat map: bright parts are the object, dark ones
/// its background.
double opacity(grid::Type type, bool agent, const std::uint8_t* pixel) {
  if (agent || (type != grid::Type::unseen && type != grid::Type::empty)) {
    const double brightness = std::max({pixel[0], pixel[1], pixel[2]}) / 255.0;
    return type == grid::Type::wall ? 0.4 : 0.75 * brightness;
  }
  return 0;
}

/// 49 values as colors from 0 to `highest`, with what is in the cells shining through.
Image heat_map(std::span<const float> values, double highest, ViewBytes view, TileRenderer& tiles) {
  constexpr double kLine = 0.16;  // opacity of the lines between cells
  const int size = tiles.tile_size();
  const Image objects = tiles.view(view, false);
  Image map(size * grid::kViewSize, size * grid::kViewSize);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto cell = static_cast<std::size_t>(x / size * grid::kViewSize + y / size);
      const bool agent = x / size == grid::kViewSize / 2 && y / size == grid::kViewSize - 1;
      const bool line = (x > 0 && x % size == 0) || (y > 0 && y % size == 0);
      const auto type = static_cast<grid::Type>(view[3 * cell]);
      const double value = fraction(values[cell], highest);
      const Rgb heat = magma(value);
      const std::uint8_t* object = line ? kWhite.data() : objects.pixel(x, y);
      const double part = line ? kLine : opacity(type, agent, object);
      const double shade = line ? 1 : 1 - 0.5 * value;  // else bright objects vanish in hot cells
      for (std::size_t c = 0; c < 3; ++c) {
        map.pixel(x, y)[c] =
            static_cast<std::uint8_t>(std::lround((1 - part) * heat[c] + part * shade * object[c]));
      }
    }
  }
  return map;
}

class Figure {
 public:
  Figure(const policy::StepRecord& step, const Scene& scene)
      : step_(step),
        scene_(scene),
        words_(static_cast<int>(step.word_weights.size())),
        title_(Canvas(1, 1).wrapped(babyai::text(scene.sentence), kTitle, kContent)),
        panels_y_(kMargin + 34 * static_cast<int>(title_.size()) + 62),
        words_y_(panels_y_ + kPanel + 84),
        masked_(std::ranges::any_of(step.word_mask, [](float a) { return a < 0.995f; })),
        word_height_(kWordMap + (masked_ ? 96 : 76)),
        canvas_(kWidth, height()) {}

  Image draw() {
    draw_head();
    draw_panels();
    if (words_ > 0) draw_words();
    return canvas_.finished();
  }

 private:
  int height() const {
    if (words_ == 0) return panels_y_ + kPanel + kMargin;
    const int rows = (words_ + kWordsPerRow - 1) / kWordsPerRow;
    return words_y_ + rows * word_height_ + kMargin - 18;
  }

  void draw_head() {
    double y = kMargin + 20;
    for (const std::string& line : title_) {
      canvas_.text(kMargin, y, line, kTitle);
      y += 34;
    }
    std::string note = fmt::format("{}   step {}   action: {}   value {:.2f}", scene_.env_id,
                                   step_.step, action_name(), step_.value);
    if (step_.reward != 0) note += fmt::format("   reward {:.2f}", step_.reward);
    canvas_.text(kMargin, y - 6, note, kNote, kSoftInk);
  }

  void draw_panels() {
    TileRenderer tiles(kPanelCell);
    double x = kMargin;
    const auto next = [&](std::string_view heading, const Image& picture) {
      canvas_.text(x, panels_y_ - 12, heading, kHeading);
      canvas_.image(picture, x, panels_y_, kPanel);
      x += kPanel + kPanelGap;
    };
    // Twice as large, then scaled down: any room fills the panel and stays smooth.
    const int cells = std::max(scene_.world.grid.width(), scene_.world.grid.height());
    next("The world", TileRenderer(2 * kPanel / cells + 1).world(scene_.world));
    next("What the agent sees", tiles.view(step_.image));
    if (words_ > 0) {
      const double highest = *std::ranges::max_element(step_.attention_map);
      draw_scale(x, panels_y_ + kPanel + 10, kPanel, highest);
      next("Where it looks (M)", heat_map(step_.attention_map, highest, step_.image, tiles));
    }
    if (!step_.logits.empty()) draw_policy(x);
  }

  /// The colors of a heat map from 0 to `highest`.
  void draw_scale(double x, double y, double width, double highest) {
    const std::string label = fmt::format("{:.2f}", highest);
    Image bar(static_cast<int>(width - 26 - canvas_.text_width(label, kSmall)), 9);
    for (int column = 0; column < bar.width; ++column) {
      for (int row = 0; row < bar.height; ++row) {
        std::ranges::copy(magma(static_cast<double>(column) / (bar.width - 1)),
                          bar.pixel(column, row));
      }
    }
    canvas_.image(bar, x + 16, y, bar.width);
    canvas_.text(x, y + 9, "0", kSmall, kSoftInk);
    canvas_.text(x + width, y + 9, label, kSmall, kSoftInk, Align::right);
  }

  void draw_policy(double x) {
    const std::vector<double> p = probabilities(step_.logits);
    const double width = kWidth - kMargin - x;
    const double pitch = static_cast<double>(kPanel) / static_cast<double>(p.size());
    canvas_.text(x, panels_y_ - 12, "What it does", kHeading);
    for (std::size_t a = 0; a < p.size(); ++a) {
      const double y = panels_y_ + pitch * static_cast<double>(a);
      const bool chosen = static_cast<int>(a) == step_.action;
      const Rgb ink = chosen ? kInk : kSoftInk;
      const Font font{14, chosen};
      canvas_.text(x, y + 14, name_of_action(a), font, ink);
      canvas_.text(x + width, y + 14, fmt::format("{:.2f}", p[a]), font, ink, Align::right);
      draw_bar(x, y + 20, width, 7, fraction(p[a], 1), chosen ? kAccent : kCalm);
    }
  }

  void draw_words() {
    TileRenderer tiles(kWordCell);
    const double highest = *std::ranges::max_element(step_.word_attention);
    const float heaviest = *std::ranges::max_element(step_.word_weights);
    canvas_.text(kMargin, words_y_ - 16,
                 masked_ ? "Where each word looks (A), its weight (w) and its mask (α)"
                         : "Where each word looks (A) and its weight (w)",
                 kHeading);
    draw_scale(kWidth - kMargin - 200, words_y_ - 26, 200, highest);
    for (int word = 0; word < words_; ++word) {
      const auto i = static_cast<std::size_t>(word);
      const double x = kMargin + kWordPitch * (word % kWordsPerRow);
      double y = words_y_ + word / kWordsPerRow * word_height_;
      canvas_.image(heat_map(step_.word_attention.subspan(i * grid::kViewCells, grid::kViewCells),
                             highest, step_.image, tiles),
                    x, y, kWordMap);
      y += kWordMap + 20;
      canvas_.text(x + kWordMap / 2.0, y, babyai::word(scene_.sentence.words[i]), {16, true}, kInk,
                   Align::center);
      draw_number(x, y + 20, "w", step_.word_weights[i], heaviest, kAccent);
      if (masked_) draw_number(x, y + 40, "α", step_.word_mask[i], 1, kCalm);
    }
  }

  /// Name, bar and number in a line under a word's map.
  void draw_number(double x, double y, std::string_view name, float value, float highest,
                   Rgb color) {
    canvas_.text(x, y, name, kSmall, kSoftInk);
    canvas_.text(x + kWordMap, y, fmt::format("{:.2f}", value), kSmall, kInk, Align::right);
    draw_bar(x + 16, y - 8, kWordMap - 52, 7, fraction(value, highest), color);
  }

  void draw_bar(double x, double y, double width, double height, double part, Rgb color) {
    canvas_.rectangle(x, y, width, height, kFaint);
    canvas_.rectangle(x, y, width * part, height, color);
  }

  static std::string name_of_action(std::size_t action) {
    return action < kActionNames.size() ? std::string(kActionNames[action])
                                        : fmt::format("action {}", action);
  }
  std::string action_name() const { return name_of_action(static_cast<std::size_t>(step_.action)); }

  // In this order: each may depend on those before it.
  const policy::StepRecord& step_;
  const Scene& scene_;
  int words_;
  std::vector<std::string> title_;
  int panels_y_, words_y_;
  bool masked_;
  int word_height_;
  Canvas canvas_;
};

}  // namespace

Image decision_figure(const policy::StepRecord& step, const Scene& scene) {
  const auto words = static_cast<std::size_t>(scene.sentence.length);
  require(step.word_weights.empty() || step.word_weights.size() == words,
          "decision_figure: {} word weights for a mission of {} words", step.word_weights.size(),
          words);
  const std::size_t weights = step.word_weights.size();
  const std::size_t map = weights > 0 ? grid::kViewCells : step.attention_map.size();
  require(
      step.word_mask.size() == weights &&
          step.word_attention.size() == weights * grid::kViewCells &&
          step.attention_map.size() == map,
      "decision_figure: {} weights come with {} mask values, {} attention values and a map of {}",
      weights, step.word_mask.size(), step.word_attention.size(), step.attention_map.size());
  return Figure(step, scene).draw();
}

}  // namespace wordgaze::draw
