#include "wordgaze/draw/image.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <stdexcept>

#include "wordgaze/io/file.hpp"

namespace wordgaze::draw {

void Image::paste(const Image& part, int x, int y) {
  assert(x >= 0 && y >= 0 && x + part.width <= width && y + part.height <= height);
  for (int row = 0; row < part.height; ++row) {
    std::copy_n(part.pixel(0, row), 3 * part.width, pixel(x, y + row));
  }
}

std::string png(const Image& image) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height),
      &cairo_surface_destroy);
  const auto require_success = [&](cairo_status_t status) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw std::runtime_error(fmt::format("cannot make a PNG of {} x {} pixels: {}", image.width,
                                         image.height, cairo_status_to_string(status)));
  };
  require_success(cairo_surface_status(surface.get()));
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + y * stride);
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      row[x] =
          static_cast<std::uint32_t>(p[0]) << 16 | static_cast<std::uint32_t>(p[1]) << 8 | p[2];
    }
  }
  cairo_surface_mark_dirty(surface.get());

  std::string file;
  const auto append = [](void* out, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  require_success(cairo_surface_write_to_png_stream(surface.get(), append, &file));
  return file;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  io::write_file(path, png(image));
}

}  // namespace wordgaze::draw
