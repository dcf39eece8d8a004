#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {

/// Where a batch of B environments writes: buffers of the caller, B entries each, images one behind
/// the other. An empty span is not written.
struct BatchOutput {
  std::span<std::uint8_t> images{};      ///< B * grid::kImageBytes
  std::span<std::uint8_t> directions{};  ///< B
  std::span<double> rewards{};           ///< B
  std::span<std::uint8_t> terminated{};  ///< B, 0 or 1
  std::span<std::uint8_t> truncated{};   ///< B, 0 or 1
  /// The last view of an episode, written only where one ended: there `images` holds the first of
  /// the next.
  std::span<std::uint8_t> final_images{};      ///< B * grid::kImageBytes
  std::span<std::uint8_t> final_directions{};  ///< B
};

/// What became of an environment's episodes.
struct EpisodeStatistics {
  std::int64_t episodes = 0;  ///< that have ended
  std::int64_t successes = 0;
  double last_return = 0;  ///< of the last one that ended
  int last_length = 0;     ///< in steps
};

/// Environments of one level that step together, on the threads of a team. An environment whose
/// episode ends starts the next one in the same step. What comes out does not depend on the number
/// of threads.
class VectorEnv {
 public:
  /// On one thread. Throws as Environment's constructors do, and for a size below 1.
  VectorEnv(const babyai::LevelSpec& spec, int size);
  /// On the threads of a team, which must outlive this.
  VectorEnv(const babyai::LevelSpec& spec, int size, Team& team);

  int size() const { return static_cast<int>(environments_.size()); }
  const Environment& operator[](int k) const { return environments_[k]; }
  const EpisodeStatistics& statistics(int k) const { return statistics_[k]; }

  /// Starts environment k from seed `first_seed` + k; clears the statistics. Writes images and
  /// directions.
  void reset(std::uint64_t first_seed, const BatchOutput& out);

  /// Starts environment k from seeds[k] or, where there is none, where its random stream is; the
  /// other environments, where `chosen` is given and 0, stay as they are. Clears the statistics of
  /// those it starts, and writes their images and directions. Throws std::invalid_argument for a
  /// wrong number of seeds or choices.
  void reset(std::span<const std::optional<core::Seed>> seeds, const BatchOutput& out,
             std::span<const std::uint8_t> chosen = {});

  /// Environment k takes over a state, as Environment::restore(); clears its statistics.
  void restore(int k, std::span<const std::uint8_t> state);

  /// Writes images and directions as they are now.
  void observe(const BatchOutput& out) const;

  /// One step of each. Throws std::invalid_argument, and steps none, for a wrong number of actions,
  /// an action out of range or a buffer of a wrong size. Throws std::runtime_error when no next
  /// layout is found; the batch is then to be reset.
  void step(std::span<const grid::Action> actions, const BatchOutput& out);

 private:
  void check(const BatchOutput& out) const;
  void begin_one(int k, const BatchOutput& out);
  void step_one(int k, grid::Action action, const BatchOutput& out);
  void write_view(int k, std::span<std::uint8_t> images, std::span<std::uint8_t> directions) const;
  template <class Each>
  void for_each(Each each);

  std::vector<Environment> environments_;
  std::vector<EpisodeStatistics> statistics_;
  std::vector<double> returns_;  // of the running episodes
  std::unique_ptr<Team> own_team_;
  Team* team_;
};

}  // namespace wordgaze::env
