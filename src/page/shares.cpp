#include "shares.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace wordgaze::page {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto part = bytes.subspan(i, std::min<std::size_t>(3, bytes.size() - i));
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < part.size() ? part[k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= part.size() ? kLetters[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string shares(std::span<const float> numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(numbers.size());
  for (const float number : numbers) {
    const float share = std::isnan(number) ? 0 : std::clamp(number, 0.0f, 1.0f);
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return base64(bytes);
}

}  // namespace wordgaze::page
