#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/policy/view.hpp"

namespace wordgaze::policy {

/// Numbers over the 49 cells of a view.
struct ViewMap {
  std::array<float, grid::kViewCells> cells{};  ///< x by x, as cell_index counts

  float at(int x, int y) const { return cells[cell_index(x, y)]; }
};

/// What an agent chose, and where it looked. (docs/math.md has M, w, alpha and A)
struct Act {
  /// A word of the mission.
  struct Word {
    std::string_view text;  ///< of the vocabulary; lives as long as the program
    int sub_task = 0;       ///< that it belongs to; -1 for the words that join clauses
    float weight = 0;       ///< w: how much it counts; the weights of a mission sum to 1
    float mask = 1;         ///< alpha: 0 to 1, of the Task Attention Module; 1 without one
    ViewMap map{};          ///< A: where it looks; what is left of 1 is not in view
  };

  grid::Action action = grid::Action::done;
  std::array<float, grid::kActions> probabilities{};  ///< by action; sum to 1
  float value = 0;                                    ///< the return that the critic expects
  ViewMap gaze{};                                     ///< M; zeros for an agent without attention
  float nowhere = 0;                                  ///< what M leaves: not in view; 0 to 1
  std::vector<Word> words{};                          ///< none for an agent without attention
};

/// A trained agent for a robot: weights from a file, a mission in words, a view before each action.
/// No environment, and no other header. (docs/own-robot.md)
///
///     policy::RobotPolicy policy("models/structured.safetensors");
///     policy.begin("go to the blue key, then pick up the red ball");
///     const policy::Act act = policy.act(view);   // act.action, act.gaze, act.words, ...
///
/// For one robot and one thread at a time.
class RobotPolicy {
 public:
  /// How the agent comes to know what is done of its mission, c_t.
  enum class Completion : std::uint8_t {
    given,     ///< set_done() says it
    true_now,  ///< followed by the views: what comes true counts
    declared,  ///< followed by the views: what comes true counts when the action `done` follows
  };
  struct Options {
    Completion completion = Completion::given;
    bool greedy = true;      ///< the likeliest action; else one drawn by its probability
    std::uint64_t seed = 1;  ///< of the draws
  };

  /// A checkpoint of `train`, or a file of weights; the agent knows the cells of the level that it
  /// was trained in. Throws std::runtime_error that names the file and what is wrong with it.
  explicit RobotPolicy(const std::filesystem::path& weights) : RobotPolicy(weights, Options{}) {}
  RobotPolicy(const std::filesystem::path& weights, Options options);
  RobotPolicy(RobotPolicy&&) noexcept;
  RobotPolicy& operator=(RobotPolicy&&) noexcept;
  ~RobotPolicy();

  /// Starts a mission of the Baby language (babyai/parser.hpp): an empty memory, nothing done.
  /// Throws std::invalid_argument, and changes nothing, for a text outside of it or of more
  /// sub-tasks than the agent can tell apart, and, where views are followed, for one with a place
  /// ("on your left").
  void begin(std::string_view mission);
  /// Starts with any words of the vocabulary, each with its sub-task. Throws std::invalid_argument
  /// where views are followed: the words do not say what to look for.
  void begin(const babyai::Sentence& mission);

  /// What to do in view of this. Between two calls the robot has done what the first returned, or
  /// has said what it did instead (did()). Throws std::logic_error before begin(), and
  /// std::invalid_argument, changing nothing, for a cell that the agent does not know.
  Act act(const View& view);
  /// The same for bytes as MiniGrid's obs["image"], [x][y][type, color, state].
  Act act(std::span<const std::uint8_t, grid::kImageBytes> image);

  /// The robot did something else than act() said: only following needs to know.
  void did(grid::Action action);

  /// Things to do, in the order of the sentence: a clause is one, but "put A next to B" is two: to
  /// have A in hand, and to put it next to B.
  int sub_tasks() const;
  /// c_t, a 0/1 a sub-task, as the agent was told last.
  std::span<const std::uint8_t> completion() const;
  /// Says that a sub-task is done, or is so no longer, from the next act() on. Throws
  /// std::invalid_argument for a number that there is not, std::logic_error where views are
  /// followed.
  void set_done(int sub_task, bool done = true);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wordgaze::policy
