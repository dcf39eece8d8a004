#include "wordgaze/training/resume.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "wordgaze/core/require.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/training/trainer.hpp"

namespace wordgaze::training {

void check_same_run(std::string_view place, const TrainConfig& before, const TrainConfig& now) {
  TrainConfig as_long = before;
  as_long.frames = now.frames;
  const auto differences = io::differences(as_long, now);
  if (differences.empty()) return;
  std::string list;
  for (const auto& line : differences) list += "\n  " + line;
  throw std::invalid_argument(
      fmt::format("{} holds a run with another configuration (there, here):{}\n"
                  "give another --out, or the same settings with --resume",
                  place, list));
}

void check_frames(const TrainConfig& before, const TrainConfig& now, std::int64_t frames) {
  require(now.frames >= frames || now.frames >= before.frames,
          "frames = {}: the run is at {} already; give {} or more to go on", now.frames, frames,
          frames);
}

std::string schedule_changes(const TrainConfig& before, const TrainConfig& now,
                             std::int64_t frames) {
  std::string changes;
  const auto compare = [&](std::string_view name, double old_value, double new_value) {
    if (old_value == new_value) return;
    changes += fmt::format("{}{} from {:.3g} to {:.3g}", changes.empty() ? "" : ", ", name,
                           old_value, new_value);
  };
  const Rates a = rates_at(before, frames), b = rates_at(now, frames);
  compare("the learning rate", a.learning_rate, b.learning_rate);
  if (now.model.task_attention) {
    compare("that of the Task Attention Module", a.task_learning_rate, b.task_learning_rate);
  }
  compare("the entropy bonus", a.entropy_coefficient, b.entropy_coefficient);
  compare("the focus of the gaze", focus_at(before, frames), focus_at(now, frames));
  if (changes.empty()) return changes;
  return fmt::format(
      "frames = {} in place of {}: schedules run over all frames, so here changes {}", now.frames,
      before.frames, changes);
}

}  // namespace wordgaze::training
