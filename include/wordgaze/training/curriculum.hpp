#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/evaluation/episode.hpp"
#include "wordgaze/training/config.hpp"
#include "wordgaze/training/held_out.hpp"
#include "wordgaze/training/stretch.hpp"

namespace wordgaze::training {

/// How an episode of training ended.
struct Outcome : evaluation::Outcome {
  babyai::Verb verb{};  ///< of the first clause
  int clauses = 1;
  bool helped = false;  ///< not the task as it stands: success rates leave it out
};

/// Decides what training episodes ask for. Worlds come from the level; the curriculum changes
/// verbs, cuts a mission down to a clause or a description to a word, does a part of it, moves
/// objects around the target, or makes the room seem larger. It learns from outcomes between
/// rollouts only, so that lanes can ask it at the same time.
class Curriculum {
 public:
  explicit Curriculum(const CurriculumConfig& config);

  /// What became of an episode.
  struct Preparation {
    bool helped = false;  ///< not the task as it stands: success rates leave it out
    Stretch stretch;
  };
  /// Changes the episode that has just begun; begins the next ones in its place while the mission
  /// names what is held out. Throws std::runtime_error when that seems to go on for ever.
  Preparation prepare(env::Environment& environment, core::Rng& rng) const;

  /// Learns from what ended since the last call; `frames` were seen in all.
  void observe(const std::vector<Outcome>& outcomes, std::int64_t frames);

  double go_to_share() const { return go_to_share_; }
  bool pickup_only() const { return pickup_only_; }

  /// Everything that prepare() depends on, for checkpoints.
  std::vector<double> state() const;
  /// Throws std::invalid_argument, and changes nothing, for numbers that are not a state.
  void restore(const std::vector<double>& state);

 private:
  static constexpr std::size_t kWindow = 400;  ///< episodes a verb
  /// The last outcomes of one verb.
  struct Window {
    std::array<std::uint8_t, kWindow> success{};
    std::size_t next = 0, size = 0;
    void add(bool s);
    double rate() const;
  };

  CurriculumConfig config_;
  HeldOut held_out_;
  bool pickup_only_;
  double go_to_share_ = 0.5;
  double half_done_ = 0;
  Window go_to_, pickup_;
};

}  // namespace wordgaze::training
