#include "wordgaze/babyai/level.hpp"

#include <algorithm>
#include <charconv>

#include "generators.hpp"
#include "level_table.hpp"
#include "wordgaze/core/edit_distance.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {
namespace {

constexpr int kKinds = 18;  // colors times types: so many objects can be unique

// Reads an id from the front.
class IdReader {
 public:
  explicit IdReader(std::string_view id) : rest_(id) {}

  bool skip(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  // At most four digits.
  bool read(int& number) {
    const std::size_t digits = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    if (digits == 0 || digits > 4) return false;
    std::from_chars(rest_.data(), rest_.data() + digits, number);
    rest_.remove_prefix(digits);
    return true;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

// Wordgaze-{One,Two,Three,Four}-N{N}-K{K}[-auto]-v0, or nothing.
std::optional<LevelSpec> wordgaze_level(std::string_view id) {
  IdReader reader(id);
  int clauses = 0, size = 0, objects = 0;
  if (reader.skip("Wordgaze-One-N")) clauses = 1;
  if (reader.skip("Wordgaze-Two-N")) clauses = 2;
  if (reader.skip("Wordgaze-Three-N")) clauses = 3;
  if (reader.skip("Wordgaze-Four-N")) clauses = 4;
  if (clauses == 0 || !reader.read(size) || !reader.skip("-K") || !reader.read(objects)) {
    return std::nullopt;
  }
  const bool declared = !reader.skip("-auto");
  if (!reader.skip("-v0") || !reader.at_end()) return std::nullopt;
  require(size >= 5, "environment '{}': a room of N = {} is too small; expected N >= 5", id, size);
  // In a fuller room hardly a layout lets the agent reach every object, or none does.
  const int fit = std::min(kKinds, (size - 2) * (size - 2) / 2);
  require(objects >= clauses && objects <= fit,
          "environment '{}': K = {} objects; expected {} to {} in a room of N = {}", id, objects,
          clauses, fit, size);
  return LevelSpec{.id = std::string(id),
                   .generate = generators::one_room_task,
                   .room_size = size,
                   .rows = 1,
                   .columns = 1,
                   .done_mode = declared ? DoneMode::sequential : DoneMode::off,
                   .objects = objects,
                   .unique = true,
                   .clauses = clauses};
}

// The three ids that are written most like this one.
std::string nearest_ids(std::string_view id) {
  std::vector<std::string> ids = level_ids();
  ids.insert(ids.end(), {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0",
                         "Wordgaze-Three-N8-K4-v0", "Wordgaze-Four-N8-K4-v0"});
  std::stable_sort(ids.begin(), ids.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(id, a) < edit_distance(id, b);
  });
  return ids[0] + ", " + ids[1] + ", " + ids[2];
}

}  // namespace

LevelSpec find_level(std::string_view id) {
  for (const LevelSpec& level : level_table()) {
    if (level.id == id) return level;
  }
  if (auto level = wordgaze_level(id)) return *std::move(level);
  require(!id.starts_with("MiniGrid-WFC-"),
          "environment '{}' is not available: its patterns are missing from the reference's own "
          "package",
          id);
  throw std::invalid_argument(
      formatted("unknown environment '{}'; the nearest known ids are {}", id, nearest_ids(id)));
}

std::vector<std::string> level_ids() {
  std::vector<std::string> ids;
  for (const LevelSpec& level : level_table()) ids.push_back(level.id);
  return ids;
}

}  // namespace wordgaze::babyai
