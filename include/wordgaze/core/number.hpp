#pragma once
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

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

/// The same for whole numbers, which may be written with an exponent, as 1e6.
template <std::integral Number>
std::optional<Number> whole_number_in(std::string_view text) {
  if (const auto number = number_in<Number>(text)) return number;
  constexpr double kExact = 9007199254740992;  // 2^53: larger doubles leave integers out
  const auto number = number_in<double>(text);
  if (!number || text.find_first_of("eE") == text.npos) return std::nullopt;
  const bool whole = std::abs(*number) <= kExact && *number == std::trunc(*number);
  if (!whole || !std::in_range<Number>(static_cast<std::int64_t>(*number))) return std::nullopt;
  return static_cast<Number>(*number);
}

}  // namespace wordgaze
