#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "wordgaze/training/config.hpp"

/// Whether, and how, a run goes on with a configuration.
namespace wordgaze::training {

/// Throws std::invalid_argument with all differences unless a run that was made with `before` is
/// one of `now`, but perhaps for its frames. `place` is where the run was found.
void check_same_run(std::string_view place, const TrainConfig& before, const TrainConfig& now);

/// Throws std::invalid_argument where `now` asks for less frames than a run of `before` has seen.
void check_frames(const TrainConfig& before, const TrainConfig& now, std::int64_t frames);

/// In words, what jumps when a run of `before` goes on as `now` after so many frames: schedules run
/// over all frames. Empty where nothing does.
std::string schedule_changes(const TrainConfig& before, const TrainConfig& now,
                             std::int64_t frames);

}  // namespace wordgaze::training
