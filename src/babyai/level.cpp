#include "wordgaze/babyai/level.hpp"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "edited_id.hpp"
#include "own_id.hpp"
#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/core/edit_distance.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze_levels.hpp"

namespace wordgaze::babyai {
namespace {

struct Registry {
  std::mutex mutex;
  std::vector<LevelSpec> levels;
};

Registry& registry() {
  static Registry registry;
  return registry;
}

template <class Levels>
auto find_in(const Levels& levels, std::string_view id) {
  return std::find_if(levels.begin(), levels.end(), [&](const LevelSpec& l) { return l.id == id; });
}

bool is_built_in(std::string_view id) {
  return find_in(built_in_levels(), id) != built_in_levels().end();
}

// The three ids that are written most like this one.
std::string nearest_ids(std::string_view id) {
  std::vector<std::string> ids = level_ids();
  ids.insert(ids.end(),
             {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0", "Wordgaze-Three-N8-K4-v0",
              "Wordgaze-Four-N8-K4-v0", "Wordgaze-Five-N8-K8-v0", "Wordgaze-Six-N8-K8-v0",
              "Wordgaze-Seven-N8-K8-v0", "Wordgaze-Eight-N8-K8-v0"});
  std::vector<std::pair<std::size_t, std::string>> far;
  for (std::string& known : ids) far.emplace_back(edit_distance(id, known), std::move(known));
  std::ranges::stable_sort(far, {}, &std::pair<std::size_t, std::string>::first);
  return far[0].second + ", " + far[1].second + ", " + far[2].second;
}

}  // namespace

LevelSpec find_level(std::string_view id) {
  const auto built_in = find_in(built_in_levels(), id);
  if (built_in != built_in_levels().end()) return *built_in;
  {
    Registry& known = registry();
    const std::scoped_lock lock(known.mutex);
    const auto own = find_in(known.levels, id);
    if (own != known.levels.end()) return *own;
  }
  if (auto level = wordgaze_level(id)) {
    validate(*level);
    return *std::move(level);
  }
  if (const EditedId parsed = EditedId::parse(id); parsed.is_edited()) {
    LevelSpec level = edited(find_level(parsed.base), parsed.edit);
    if (level.id == id) return level;  // else an edit changes nothing
  }
  require(!id.starts_with("MiniGrid-WFC-"),
          "environment '{}' is not available: its patterns are missing from the reference's own "
          "package",
          shortened(id));
  throw std::invalid_argument(formatted("unknown environment '{}'; the nearest known ids are {}",
                                        shortened(id), nearest_ids(id)));
}

std::vector<std::string> level_ids() {
  std::vector<std::string> ids;
  for (const LevelSpec& level : built_in_levels()) ids.push_back(level.id);
  Registry& known = registry();
  const std::scoped_lock lock(known.mutex);
  for (const LevelSpec& level : known.levels) ids.push_back(level.id);
  return ids;
}

void check_own_id(std::string_view id) {
  // Programs take ids in lists with commas, and brackets hold edits.
  const bool plain =
      std::ranges::all_of(id, [](char c) { return static_cast<unsigned char>(c) > ' '; });
  require(!id.empty() && plain && id.find_first_of(",[]") == id.npos,
          "'{}' is no id of a level; expected one without spaces, commas and brackets",
          shortened(id));
  require(!is_built_in(id) && !wordgaze_level(id),
          "'{}' is the id of a built-in level; choose another", id);
}

void register_level(LevelSpec level) {
  const std::string& id = level.id;
  check_own_id(id);
  validate(level);
  Registry& known = registry();
  const std::scoped_lock lock(known.mutex);
  require(find_in(known.levels, id) == known.levels.end(),
          "register_level: '{}' is registered already; choose another id", id);
  known.levels.push_back(std::move(level));
}

}  // namespace wordgaze::babyai
