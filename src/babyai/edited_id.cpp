#include "edited_id.hpp"

#include <charconv>

#include "wordgaze/core/formatted.hpp"

namespace wordgaze::babyai {
namespace {

constexpr std::string_view kRoomSize = "room_size=", kObjects = "objects=";

// Takes "name" and a number off the front.
std::optional<int> take(std::string_view& text, std::string_view name) {
  if (!text.starts_with(name)) return std::nullopt;
  int value = 0;
  const char* begin = text.data() + name.size();
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

EditedId EditedId::parse(std::string_view id) {
  const EditedId unedited{std::string(id)};
  const std::size_t open = id.find('[');
  if (open == id.npos) return unedited;
  std::string_view rest = id.substr(open + 1);
  EditedId edited{std::string(id.substr(0, open))};
  edited.edit.room_size = take(rest, kRoomSize);
  if (edited.edit.room_size && rest.starts_with(',')) rest.remove_prefix(1);
  edited.edit.objects = take(rest, kObjects);
  return edited.is_edited() && edited.text() == id ? edited : unedited;
}

std::string EditedId::text() const {
  if (!is_edited()) return base;
  std::string edits;
  if (edit.room_size) edits += formatted("{}{}", kRoomSize, *edit.room_size);
  if (edit.room_size && edit.objects) edits += ',';
  if (edit.objects) edits += formatted("{}{}", kObjects, *edit.objects);
  return formatted("{}[{}]", base, edits);
}

}  // namespace wordgaze::babyai
