#pragma once
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "game.hpp"
#include "output.hpp"
#include "wordgaze/grid/action.hpp"

namespace wordgaze::apps {

/// The keyboard without waiting for the end of a line, as long as it lives; what comes through a
/// pipe is read as it is.
class Keyboard {
 public:
  Keyboard() {
    raw_ = ::isatty(STDIN_FILENO) != 0 && ::tcgetattr(STDIN_FILENO, &before_) == 0;
    set(true);
  }
  ~Keyboard() { set(false); }
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// A key, or an arrow as its last letter: 'A' up, 'B' down, 'C' right, 'D' left; 0 at the end.
  char key() {
    const char first = read();
    if (first != '\033') return first;
    return read() == '[' ? read() : '\033';
  }
  std::string line() {
    set(false);
    std::string text;
    for (char c = read(); c != 0 && c != '\n' && text.size() < 400; c = read()) text += c;
    set(true);
    return text;
  }

 private:
  static char read() {
    char c = 0;
    return ::read(STDIN_FILENO, &c, 1) == 1 ? c : '\0';
  }
  void set(bool raw) {
    if (!raw_) return;
    termios now = before_;
    if (raw) now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &now);
  }

  bool raw_ = false;
  termios before_{};
};

/// The game in letters: the world, how much each word counts, where the agent looks.
class TerminalScreen final : public Game::Screen, private policy::Observer {
 public:
  policy::Observer& preview() override { return *this; }

 private:
  bool wants_episode(std::int64_t) override { return true; }
  bool wants_scenes() const override { return true; }
  void on_begin(const policy::EpisodeBegin& begin) override {
    words_.clear();
    for (const babyai::WordId id : begin.sentence) words_.emplace_back(babyai::word(id));
  }
  void on_scene(const policy::SceneRecord& scene) override {
    world_.clear();
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const auto at = static_cast<std::size_t>(3 * (x * scene.height + y));
        const bool agent = x == scene.agent_x && y == scene.agent_y;
        const bool target = std::ranges::find(scene.targets, grid::at(x, y)) != scene.targets.end();
        world_ += agent ? kAgents[static_cast<std::size_t>(scene.direction)]
                        : letter(scene.cells.subspan(at, 3), target);
      }
      world_ += "\n";
    }
    hand_ = scene.carried[0] > 1 ? fmt::format("in its hand: {} {}\n", name_of(scene.carried[1]),
                                               grid::kTypeNames[scene.carried[0]])
                                 : std::string();
  }
  void on_step(const policy::StepRecord& step) override {
    std::string text = "\n" + world_ + hand_;
    for (std::size_t i = 0; i < words_.size() && i < step.word_weights.size(); ++i) {
      const float part = step.word_weights[i] * step.word_mask[i];
      text += fmt::format("  {:<10} {:.2f} {}\n", words_[i], part,
                          std::string(static_cast<std::size_t>(std::max(0.0f, 20 * part)), '#'));
    }
    if (step.word_weights.empty()) {
      for (const auto& word : words_) text += "  " + word;
      text += "\n";
    }
    text += step.nowhere > 0.5f ? "looks: not in view\n" : looks(step);
    text += fmt::format("step {}, the agent would: {}\n", step.step,
                        grid::kActionPhrases[static_cast<std::size_t>(step.action)]);
    say("{}", text);
  }

  static std::string looks(const policy::StepRecord& step) {
    if (step.attention_map.empty()) return "";
    const auto brightest = std::ranges::max_element(step.attention_map);
    const int cell = static_cast<int>(brightest - step.attention_map.begin());
    const auto* code = &step.image[static_cast<std::size_t>(3 * cell)];
    return fmt::format("looks: {} {}, {} ahead, {} to the right ({:.2f})\n", name_of(code[1]),
                       code[0] < grid::kTypeNames.size() ? grid::kTypeNames[code[0]] : "thing",
                       6 - cell % 7, cell / 7 - 3, *brightest);
  }
  static std::string_view name_of(std::uint8_t color) {
    return color < grid::kColorNames.size() ? grid::kColorNames[color] : "odd";
  }
  /// Two characters a cell, colored; a target in brackets.
  static std::string letter(std::span<const std::uint8_t> code, bool target) {
    constexpr std::string_view kLetters = " .#_DkobGL";
    constexpr std::array<int, 6> kCodes{31, 32, 34, 35, 33, 37};
    const char letter = code[0] < kLetters.size() ? kLetters[code[0]] : '?';
    if (code[0] < 4) return fmt::format("{} ", letter);
    const int color = code[1] < kCodes.size() ? kCodes[code[1]] : 37;
    return fmt::format("\033[{};{}m{}\033[0m{}", target ? 7 : 1, color, letter, target ? "*" : " ");
  }

  static constexpr std::array<std::string_view, 4> kAgents{"> ", "v ", "< ", "^ "};
  std::vector<std::string> words_;
  std::string world_, hand_;
};

}  // namespace wordgaze::apps
