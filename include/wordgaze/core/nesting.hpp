#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

namespace wordgaze {

/// How deep the lists and objects of a JSON text nest: to be asked before a parser or a walk recurs
/// into them.
constexpr int json_nesting(std::string_view json) {
  int depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;  // what follows is no end
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace wordgaze
