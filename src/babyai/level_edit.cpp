#include "wordgaze/babyai/level_edit.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "edited_id.hpp"
#include "needs.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze_levels.hpp"

namespace wordgaze::babyai {
namespace {

// The number itself, for those parameters that have one.
template <class Chosen>
auto* objects_in(Chosen& parameters) {
  using Count = std::conditional_t<std::is_const_v<Chosen>, const int, int>;
  Count* count = nullptr;
  if (auto* p = std::get_if<Objects>(&parameters)) count = &p->count;
  if (auto* p = std::get_if<OneRoomTask>(&parameters)) count = &p->objects;
  if (auto* p = std::get_if<Missions>(&parameters)) count = &p->objects;
  return count;
}

}  // namespace

std::optional<int> objects(const LevelSpec& level) {
  const int* count = objects_in(level.parameters);
  return count != nullptr ? std::optional(*count) : std::nullopt;
}

int max_objects(const LevelSpec& level) {
  return objects(level) ? std::max(object_limits(level).high, 0) : 0;
}

LevelSpec edited(const LevelSpec& level, const Edit& edit) {
  LevelSpec result = level;
  EditedId id = EditedId::parse(level.id);
  const auto* plan = std::get_if<Plan>(&level.parameters);
  require(!edit.room_size || plan == nullptr || !plan->is_map(),
          "level '{}': room_size = {}; expected none, as it is a map", level.id,
          edit.room_size.value_or(0));
  if (edit.room_size && *edit.room_size != level.room_size) {
    id.edit.room_size = result.room_size = *edit.room_size;
  }
  if (edit.objects && edit.objects != objects(level)) {
    int* count = objects_in(result.parameters);
    require(count != nullptr, "level '{}': objects = {}; expected none, as it scatters no objects",
            level.id, *edit.objects);
    id.edit.objects = *count = *edit.objects;
  }
  validate(result);
  result.id = wordgaze_level(level.id) ? wordgaze_id(result) : id.text();
  return result;
}

}  // namespace wordgaze::babyai
