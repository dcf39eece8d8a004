#include "edited_id.hpp"

#include <charconv>
#include <system_error>

#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {
namespace {

constexpr std::string_view kRoomSize = "[room_size=", kObjects = "[objects=";

// Takes "[name=", a number and "]" off the front.
std::optional<int> take(std::string_view& text, std::string_view name) {
  if (!text.starts_with(name)) return std::nullopt;
  int value = 0;
  const char* begin = text.data() + name.size();
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  require(error != std::errc::result_out_of_range,
          "environment '...{}': the number is too large for any level", shortened(text));
  const auto behind = static_cast<std::size_t>(end - text.data());
  if (error != std::errc{} || behind == text.size() || *end != ']') return std::nullopt;
  text.remove_prefix(behind + 1);
  return value;
}

}  // namespace

EditedId EditedId::parse(std::string_view id) {
  const EditedId unedited{std::string(id)};
  const std::size_t open = id.find('[');
  if (open == id.npos) return unedited;
  std::string_view rest = id.substr(open);
  EditedId edited{std::string(id.substr(0, open))};
  edited.edit.room_size = take(rest, kRoomSize);
  edited.edit.objects = take(rest, kObjects);
  return edited.text() == id ? edited : unedited;
}

std::string EditedId::text() const {
  std::string text = base;
  if (edit.room_size) text += formatted("{}{}]", kRoomSize, *edit.room_size);
  if (edit.objects) text += formatted("{}{}]", kObjects, *edit.objects);
  return text;
}

}  // namespace wordgaze::babyai
