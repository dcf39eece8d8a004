#pragma once
#include <charconv>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

/// Messages from a pattern and values, without a library for it.
namespace wordgaze {

/// A pattern with `n` places `{}`; any other number, or a lone brace, does not compile.
template <std::size_t n>
struct Pattern {
  std::string_view text;

  consteval Pattern(const char* pattern) : text(pattern) {  // NOLINT: a literal is a pattern
    std::size_t places = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '}') throw "a '}' without its '{'";
      if (text[i] != '{') continue;
      if (i + 1 == text.size() || text[++i] != '}') throw "a '{' without its '}'";
      ++places;
    }
    if (places != n) throw "one '{}' for each value";
  }
};

namespace detail {

template <class Value>
std::string as_text(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return std::string(std::string_view(value));
  } else if constexpr (std::is_same_v<Value, char>) {
    return {value};
  } else if constexpr (std::is_same_v<Value, bool>) {
    return value ? "true" : "false";
  } else {
    static_assert(std::is_arithmetic_v<Value>, "a message takes text, numbers and booleans");
    char digits[64];  // the shortest that read as the same number
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
  }
}

inline std::string fill(std::string_view pattern, std::initializer_list<std::string> values) {
  std::string text;
  for (const std::string& value : values) {
    const std::size_t place = pattern.find("{}");
    text.append(pattern.substr(0, place)).append(value);
    pattern.remove_prefix(place + 2);
  }
  return text.append(pattern);
}

}  // namespace detail

/// The pattern with a value in each of its places: text, numbers, booleans.
template <class... Values>
std::string formatted(Pattern<sizeof...(Values)> pattern, const Values&... values) {
  return detail::fill(pattern.text, {detail::as_text(values)...});
}

/// Text for a message that must stay one: the beginning of a long one, and how long it is.
inline std::string shortened(std::string_view text, std::size_t longest = 120) {
  if (text.size() <= longest) return std::string(text);
  return formatted("{}... ({} characters)", text.substr(0, longest / 2), text.size());
}

}  // namespace wordgaze
