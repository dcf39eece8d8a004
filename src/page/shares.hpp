#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace wordgaze::page {

/// Bytes as text.
std::string base64(std::span<const std::uint8_t> bytes);

/// Numbers from 0 to 1 in 255 steps, a byte each, as text; what is no number is 0.
std::string shares(std::span<const float> numbers);

}  // namespace wordgaze::page
