#include "wordgaze/draw/image.hpp"

#include <memory>

#include "canvas.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::draw {

std::string png(const Image& image) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      surface_of(image), &cairo_surface_destroy);
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
