#include "wordgaze/babyai/level.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "generators.hpp"
#include "level_table.hpp"
#include "wordgaze/core/edit_distance.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {
namespace {

constexpr int kKinds = 18;  // colors times types: so many objects can be unique

// Wordgaze-{One,Two}-N{N}-K{K}[-auto]-v0, or nothing.
std::optional<LevelSpec> wordgaze_level(const std::string& id) {
  static const std::regex kPattern("Wordgaze-(One|Two)-N([0-9]{1,4})-K([0-9]{1,4})(-auto)?-v0");
  std::smatch part;
  if (!std::regex_match(id, part, kPattern)) return std::nullopt;
  const int size = std::stoi(part[2]), objects = std::stoi(part[3]);
  const int clauses = part[1] == "One" ? 1 : 2;
  require(size >= 5, "environment '{}': a room of N = {} is too small; expected N >= 5", id, size);
  // In a fuller room hardly a layout lets the agent reach every object, or none does.
  const int fit = std::min(kKinds, (size - 2) * (size - 2) / 2);
  require(objects >= clauses && objects <= fit,
          "environment '{}': K = {} objects; expected {} to {} in a room of N = {}", id, objects,
          clauses, fit, size);
  return LevelSpec{.id = id,
                   .generate = generators::one_room_task,
                   .room_size = size,
                   .rows = 1,
                   .columns = 1,
                   .done_mode = part[4].matched ? DoneMode::off : DoneMode::sequential,
                   .objects = objects,
                   .unique = true,
                   .clauses = clauses};
}

std::vector<std::string> nearest_ids(std::string_view id) {
  std::vector<std::string> ids = level_ids();
  ids.insert(ids.end(), {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0"});
  std::stable_sort(ids.begin(), ids.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(id, a) < edit_distance(id, b);
  });
  ids.resize(std::min<std::size_t>(ids.size(), 3));
  return ids;
}

}  // namespace

LevelSpec find_level(std::string_view id) {
  for (const LevelSpec& level : level_table()) {
    if (level.id == id) return level;
  }
  if (auto level = wordgaze_level(std::string(id))) return *std::move(level);
  require(!id.starts_with("MiniGrid-WFC-"),
          "environment '{}' is not available: its patterns are missing from the reference's own "
          "package",
          id);
  throw std::invalid_argument(fmt::format("unknown environment '{}'; the nearest known ids are {}",
                                          id, fmt::join(nearest_ids(id), ", ")));
}

std::vector<std::string> level_ids() {
  std::vector<std::string> ids;
  for (const LevelSpec& level : level_table()) ids.push_back(level.id);
  return ids;
}

}  // namespace wordgaze::babyai
