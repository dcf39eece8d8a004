#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace wordgaze::draw {

using Rgb = std::array<std::uint8_t, 3>;

/// Pixels row by row from the top left, as NumPy's [height][width][3].
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        rgb(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height) * 3) {}

  std::uint8_t* pixel(int x, int y) {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
  }
  const std::uint8_t* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }

  /// Copies `part`, which must fit, to the place with its top left corner at (x, y).
  void paste(const Image& part, int x, int y) {
    assert(x >= 0 && y >= 0 && x + part.width <= width && y + part.height <= height);
    for (int row = 0; row < part.height; ++row) {
      std::copy_n(part.pixel(0, row), 3 * part.width, pixel(x, y + row));
    }
  }

  bool operator==(const Image&) const = default;
};

/// The bytes of a PNG file.
std::string png(const Image& image);
/// All or nothing; throws std::runtime_error that names the file and the cause.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace wordgaze::draw
