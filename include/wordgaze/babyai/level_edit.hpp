#pragma once
#include <optional>

#include "wordgaze/babyai/level.hpp"

/// Levels like another one.
namespace wordgaze::babyai {

/// How many objects the level scatters; none where that is not a number of the level.
std::optional<int> objects(const LevelSpec& level);

/// The most that the level could scatter in its rooms; 0 where it scatters none.
int max_objects(const LevelSpec& level);

/// What to change; the rest stays, a step limit of its own included.
struct Edit {
  std::optional<int> room_size{};  ///< walls included
  std::optional<int> objects{};
};

/// The same level, edited; valid, and with an id that tells what it is, which find_level knows when
/// it knows that of the level: Wordgaze-One-N12-K8-v0, or
/// BabyAI-GoToLocal-v0[room_size=10][objects=4]. Throws std::invalid_argument for a number that the
/// level cannot have.
LevelSpec edited(const LevelSpec& level, const Edit& edit);

inline LevelSpec with_room(const LevelSpec& level, int room_size) {
  return edited(level, {.room_size = room_size});
}
inline LevelSpec with_objects(const LevelSpec& level, int count) {
  return edited(level, {.objects = count});
}

}  // namespace wordgaze::babyai
