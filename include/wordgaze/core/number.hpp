#pragma once
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace wordgaze {

/// The number that a text is, all of it, as programs write numbers: without spaces and without a
/// plus sign. None for anything else, and for what the type cannot hold.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [behind, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || behind != end || text.empty()) return std::nullopt;
  return number;
}

}  // namespace wordgaze
