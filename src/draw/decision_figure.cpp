#include "wordgaze/draw/decision_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "canvas.hpp"
#include "color_map.hpp"
#include "heat_map.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/draw/tile.hpp"
#include "wordgaze/evaluation/roles.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::draw {
namespace {

constexpr int kWidth = 1200, kMargin = 40;
constexpr int kContent = kWidth - 2 * kMargin;
constexpr int kPanel = 280;  // the three large squares
constexpr int kPanelGap = 32;
constexpr int kPanelCell = kPanel / grid::kViewSize;
constexpr int kWordCell = 16, kWordMap = kWordCell * grid::kViewSize;
constexpr int kNowhereRow = 20;
constexpr double kFrame = 3, kSmallFrame = 2;
constexpr int kWordsPerRow = 8;
constexpr double kWordPitch = static_cast<double>(kContent + 32) / kWordsPerRow;
constexpr int kTitleLine = 34;
constexpr int kNoteRow = 30;  // below the panels
constexpr Font kTitle{26, true}, kHeading{15, true}, kNote{14, false}, kSmall{12.5, false};

/// By grid::Direction.
constexpr std::array<std::string_view, 4> kArrows{"→ right", "↓ down", "← left", "↑ up"};

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

/// What a map leaves to nowhere, which is no cell of the view.
double rest_of(std::span<const float> map) {
  return fraction(1 - std::accumulate(map.begin(), map.end(), 0.0), 1);
}

/// Whether the agent has such a place. Of an agent without one each word's map sums to 1, but for
/// rounding; M does not where a mask dims words.
bool can_say_nowhere(std::span<const float> word_maps) {
  for (std::size_t start = 0; start < word_maps.size(); start += grid::kViewCells) {
    if (rest_of(word_maps.subspan(start, grid::kViewCells)) > 0.001) return true;
  }
  return false;
}

Rgb mixed(Rgb a, Rgb b, double part_of_b) {
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] = static_cast<std::uint8_t>(std::lround((1 - part_of_b) * a[c] + part_of_b * b[c]));
  }
  return color;
}

/// A word of the title: where it begins, and in which line.
struct Placed {
  std::string_view word;
  double x = 0;
  int line = 0;
};

/// The words in lines that fit the sheet; a comma keeps to the word before it.
std::vector<Placed> title_of(const babyai::Sentence& sentence) {
  Canvas canvas(1, 1);
  const double space = canvas.text_width(" ", kTitle);
  std::vector<Placed> title;
  double x = 0;
  int line = 0;
  for (const babyai::WordId id : sentence) {
    const std::string_view word = babyai::word(id);
    const double width = canvas.text_width(word, kTitle);
    if (x > 0 && word != ",") {
      x += space;
      if (x + width > kContent) {
        x = 0;
        ++line;
      }
    }
    title.push_back({.word = word, .x = x, .line = line});
    x += width;
  }
  return title;
}

class Figure {
 public:
  Figure(const policy::StepRecord& step, const Scene& scene)
      : step_(step),
        scene_(scene),
        words_(static_cast<int>(step.word_weights.size())),
        title_(title_of(scene.sentence)),
        title_height_(kTitleLine * (title_.empty() ? 1 : title_.back().line + 1)),
        panels_y_(kMargin + title_height_ + 62),
        nowhere_(can_say_nowhere(step.word_attention)),
        words_y_(panels_y_ + kPanel + (nowhere_ ? 84 + kNoteRow : 84)),
        masked_(std::ranges::any_of(step.word_mask, [](float a) { return a < 0.995f; })),
        word_height_(kWordMap + 76 + (masked_ ? 20 : 0) + (nowhere_ ? kNowhereRow : 0)),
        canvas_(kWidth, height()) {}

  Image draw() {
    draw_head();
    draw_panels();
    if (words_ > 0) draw_words();
    return canvas_.finished();
  }

 private:
  int height() const {
    if (words_ == 0) return panels_y_ + kPanel + kNoteRow + kMargin;
    const int rows = (words_ + kWordsPerRow - 1) / kWordsPerRow;
    return words_y_ + rows * word_height_ + kMargin - 18;
  }

  void draw_head() {
    for (std::size_t word = 0; word < title_.size(); ++word) {
      canvas_.text(kMargin + title_[word].x, kMargin + 20 + kTitleLine * title_[word].line,
                   title_[word].word, kTitle, ink(word));
    }
    std::string note = fmt::format("{}   step {}   action: {}   value {:.2f}", scene_.env_id,
                                   step_.step, action_name(), step_.value);
    if (step_.reward != 0) note += fmt::format("   reward {:.2f}", step_.reward);
    canvas_.text(kMargin, kMargin + title_height_ + 14, note, kNote, kSoftInk);
  }

  void draw_panels() {
    double x = kMargin;
    const auto next = [&](std::string_view heading, const Image& picture) {
      canvas_.text(x, panels_y_ - 12, heading, kHeading);
      canvas_.image(picture, x, panels_y_, kPanel);
    };
    // Twice as large, then scaled down: any room fills the panel and stays smooth.
    const int cells = std::max(scene_.world.grid.width(), scene_.world.grid.height());
    next("The world", TileRenderer(2 * kPanel / cells + 1).world(scene_.world));
    mark_targets_in_world(x, static_cast<double>(kPanel) / cells);
    x += kPanel + kPanelGap;

    next("What the agent sees", TileRenderer(kPanelCell).view(step_.image));
    mark_targets_in_view(x, panels_y_, kPanelCell, kFrame);
    const auto looks = static_cast<std::size_t>(scene_.world.direction);
    canvas_.text(
        x, panels_y_ + kPanel + 20,
        fmt::format("{}: ↑ here is {} in the world",
                    scene_.world.direction == grid::Direction::up ? "Not turned" : "Turned",
                    kArrows[looks]),
        kNote, kSoftInk);
    x += kPanel + kPanelGap;

    if (words_ > 0) {
      next("Where it looks (M)", heat_map(step_.attention_map, step_.image, kPanelCell));
      mark_targets_in_view(x, panels_y_, kPanelCell, kFrame);
      double y = panels_y_ + kPanel + 10;
      if (nowhere_) {
        const double share = rest_of(step_.attention_map);
        const double end = draw_nowhere(x, y, 20, share, kNote);
        if (share > 0.5) canvas_.text(end + 8, y + 15, "not in view", kHeading, kAlarm);
        y += kNoteRow;
      }
      draw_scale(x, y, kPanel);
      x += kPanel + kPanelGap;
    }
    if (!step_.logits.empty()) draw_policy(x);
  }

  void mark_targets_in_view(double x, double y, int cell, double line) {
    const evaluation::Roles roles = evaluation::roles_of(step_.image, scene_.progress);
    for (int c = 0; c < grid::kViewCells; ++c) {
      if (roles[static_cast<std::size_t>(c)] != evaluation::Role::target) continue;
      canvas_.frame(x + c / grid::kViewSize * cell, y + c % grid::kViewSize * cell, cell, line,
                    kTarget);
    }
  }

  /// Those that the agent does not see too, and the one in its hand.
  void mark_targets_in_world(double x, double cell) {
    const auto targets = babyai::target_cells(scene_.world, scene_.progress);
    for (const grid::Position p : targets) {
      canvas_.frame(x + p.x * cell, panels_y_ + p.y * cell, cell, cell < 20 ? kSmallFrame : kFrame,
                    kTarget);
    }
    const double y = panels_y_ + kPanel + 20;
    if (!targets.empty()) {
      canvas_.frame(x + kFrame, y - 11, 10, kFrame, kTarget);
      canvas_.text(x + 22, y, "target", kNote, kSoftInk);
      x += 90;
    }
    canvas_.text(x, y, "lighter: what the agent sees", kNote, kSoftInk);
  }

  /// The colors of all heat maps, and which share each is.
  void draw_scale(double x, double y, int width) {
    Image bar(width, 9);
    for (int column = 0; column < bar.width; ++column) {
      for (int row = 0; row < bar.height; ++row) {
        std::ranges::copy(magma(static_cast<double>(column) / (bar.width - 1)),
                          bar.pixel(column, row));
      }
    }
    canvas_.image(bar, x, y, bar.width);
    for (const double share : {0.0, 0.02, 0.1, 0.25, 0.5, 1.0}) {
      const double at = x + place_on_bar(share) * width;
      const Align align = share == 0 ? Align::left : share == 1 ? Align::right : Align::center;
      canvas_.rectangle(std::min(at, x + width - 1), y + 9, 1, 4, kSoftInk);
      canvas_.text(at, y + 25, fmt::format("{:.4g}", share), kSmall, kSoftInk, align);
    }
  }

  /// The fiftieth place of a map, in its color, and what it has. Returns where the text ends.
  double draw_nowhere(double x, double y, double cell, double share, Font font) {
    canvas_.frame(x + 1, y + 1, cell - 2, 1, kSoftInk);
    canvas_.rectangle(x + 1, y + 1, cell - 2, cell - 2, heat(share));
    const std::string text = fmt::format("nowhere {:.2f}", share);
    canvas_.text(x + cell + 6, y + 0.5 * (cell + 0.7 * font.size), text, font, kSoftInk);
    return x + cell + 6 + canvas_.text_width(text, font);
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
    const std::string_view heading =
        masked_ ? "Where each word looks (A), its weight (w) and its mask (α)"
                : "Where each word looks (A) and its weight (w)";
    canvas_.text(kMargin, words_y_ - 16, heading, kHeading);
    canvas_.text(kMargin + canvas_.text_width(heading, kHeading) + 14, words_y_ - 16,
                 "colors as above; bars from 0 to 1; dark words count more", kNote, kSoftInk);
    for (int word = 0; word < words_; ++word) {
      const auto i = static_cast<std::size_t>(word);
      const double x = kMargin + kWordPitch * (word % kWordsPerRow);
      double y = words_y_ + word / kWordsPerRow * word_height_;
      const auto map = step_.word_attention.subspan(i * grid::kViewCells, grid::kViewCells);
      canvas_.image(heat_map(map, step_.image, kWordCell), x, y, kWordMap);
      mark_targets_in_view(x, y, kWordCell, kSmallFrame);
      y += kWordMap;
      if (nowhere_) {
        draw_nowhere(x, y + 5, kWordCell, rest_of(map), kSmall);
        y += kNowhereRow;
      }
      y += 20;
      canvas_.text(x + kWordMap / 2.0, y, babyai::word(scene_.sentence.words[i]), {16, true},
                   ink(i), Align::center);
      draw_number(x, y + 20, "w", step_.word_weights[i], kAccent);
      if (masked_) draw_number(x, y + 40, "α", step_.word_mask[i], kCalm);
    }
  }

  /// A word is the darker the more of M is its own: in full ink from half more than an even share.
  Rgb ink(std::size_t word) const {
    if (words_ == 0) return kInk;
    const double part = static_cast<double>(step_.word_mask[word]) * step_.word_weights[word];
    return mixed(kPale, kInk, fraction(part * words_, 1.5));
  }

  /// Name, bar and number in a line under a word's map.
  void draw_number(double x, double y, std::string_view name, float value, Rgb color) {
    canvas_.text(x, y, name, kSmall, kSoftInk);
    canvas_.text(x + kWordMap, y, fmt::format("{:.2f}", value), kSmall, kInk, Align::right);
    draw_bar(x + 16, y - 8, kWordMap - 52, 7, fraction(value, 1), color);
  }

  void draw_bar(double x, double y, double width, double height, double part, Rgb color) {
    canvas_.rectangle(x, y, width, height, kFaint);
    canvas_.rectangle(x, y, width * part, height, color);
  }

  static std::string name_of_action(std::size_t action) {
    return action < grid::kActionPhrases.size() ? std::string(grid::kActionPhrases[action])
                                                : fmt::format("action {}", action);
  }
  std::string action_name() const { return name_of_action(static_cast<std::size_t>(step_.action)); }

  // In this order: each may depend on those before it.
  const policy::StepRecord& step_;
  const Scene& scene_;
  int words_;
  std::vector<Placed> title_;
  int title_height_, panels_y_;
  bool nowhere_;
  int words_y_;
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
