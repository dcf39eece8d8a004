#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace wordgaze {

namespace detail {
/// By the polynomial, its bits reversed.
constexpr std::array<std::uint32_t, 256> crc_table(std::uint32_t polynomial) {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? polynomial : 0u);
    table[i] = crc;
  }
  return table;
}

template <std::uint32_t kPolynomial>
constexpr std::uint32_t crc(std::string_view bytes, std::uint32_t before) {
  constexpr auto kTable = crc_table(kPolynomial);
  std::uint32_t crc = ~before;
  for (const char byte : bytes) {
    crc = (crc >> 8) ^ kTable[(crc ^ static_cast<std::uint8_t>(byte)) & 0xFF];
  }
  return ~crc;
}
}  // namespace detail

/// The checksum of zlib and PNG. Of bytes that come in pieces: pass the result for the piece
/// before.
constexpr std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  return detail::crc<0xEDB88320u>(bytes, before);
}

inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  return crc32({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Castagnoli's, which TensorFlow's records carry.
constexpr std::uint32_t crc32c(std::string_view bytes) {
  return detail::crc<0x82F63B78u>(bytes, 0);
}

}  // namespace wordgaze
