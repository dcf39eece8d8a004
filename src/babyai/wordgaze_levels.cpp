#include "wordgaze_levels.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/number.hpp"

namespace wordgaze::babyai {
namespace {

constexpr std::array<std::string_view, Instruction::kMaxClauses> kNumbers{
    "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight"};

constexpr std::size_t kMostDigits = 40;  // of a number in an id

// Reads an id from the front.
class IdReader {
 public:
  explicit IdReader(std::string_view id) : rest_(id) {}

  bool skip(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  // A number that is too large for an int becomes the largest: too large for a level too.
  bool read(int& number) {
    const std::size_t digits = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    if (digits == 0 || digits > kMostDigits) return false;
    number = number_in<int>(rest_.substr(0, digits)).value_or(std::numeric_limits<int>::max());
    rest_.remove_prefix(digits);
    return true;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

}  // namespace

std::optional<LevelSpec> wordgaze_level(std::string_view id) {
  IdReader reader(id);
  if (!reader.skip("Wordgaze-")) return std::nullopt;
  const auto* number = std::find_if(kNumbers.begin(), kNumbers.end(),
                                    [&](std::string_view name) { return reader.skip(name); });
  int size = 0, objects = 0;
  if (number == kNumbers.end() || !reader.skip("-N") || !reader.read(size) || !reader.skip("-K") ||
      !reader.read(objects)) {
    return std::nullopt;
  }
  const bool declared = !reader.skip("-auto");
  if (!reader.skip("-v0") || !reader.at_end()) return std::nullopt;
  const int clauses = 1 + static_cast<int>(number - kNumbers.begin());
  return LevelSpec{.id = std::string(id),
                   .generate = generators::one_room_task,
                   .room_size = size,
                   .rows = 1,
                   .columns = 1,
                   .done_mode = declared ? DoneMode::sequential : DoneMode::off,
                   .parameters = OneRoomTask{.objects = objects, .clauses = clauses}};
}

std::string wordgaze_id(const LevelSpec& level) {
  const auto& task = std::get<OneRoomTask>(level.parameters);
  return formatted("Wordgaze-{}-N{}-K{}{}-v0", kNumbers[static_cast<std::size_t>(task.clauses - 1)],
                   level.room_size, task.objects, level.done_mode == DoneMode::off ? "-auto" : "");
}

}  // namespace wordgaze::babyai
