#pragma once
#include <string>
#include <string_view>

#include "wordgaze/babyai/level_edit.hpp"

namespace wordgaze::babyai {

/// The id of a level that was edited: "Base-v0[room_size=10][objects=4]". Each level has one id:
/// any other way to write the edits is none.
struct EditedId {
  std::string base;
  Edit edit{};

  static EditedId parse(std::string_view id);
  std::string text() const;
  bool is_edited() const { return edit.room_size || edit.objects; }
};

}  // namespace wordgaze::babyai
