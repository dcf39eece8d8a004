#include "canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace wordgaze::draw {

void require_success(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(fmt::format("cannot draw: {}", cairo_status_to_string(status)));
}

cairo_surface_t* surface_of(const Image& image) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  require_success(cairo_surface_status(surface));
  unsigned char* bytes = cairo_image_surface_get_data(surface);
  for (int y = 0; y < image.height; ++y, bytes += cairo_image_surface_get_stride(surface)) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes);
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      row[x] = static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]);
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

Image image_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const unsigned char* bytes = cairo_image_surface_get_data(surface);
  for (int y = 0; y < image.height; ++y, bytes += cairo_image_surface_get_stride(surface)) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(bytes);
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(row[x] >> 16);
      p[1] = static_cast<std::uint8_t>(row[x] >> 8);
      p[2] = static_cast<std::uint8_t>(row[x]);
    }
  }
  return image;
}

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_.get())) {
  require_success(cairo_status(context_.get()));
  rectangle(0, 0, width, height, kWhite);
  // Without hints, text has the same shape wherever it stands.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
}

void Canvas::rectangle(double x, double y, double width, double height, Rgb color) {
  this->color(color);
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_fill(context_.get());
}

void Canvas::frame(double x, double y, double side, double line, Rgb color) {
  rectangle(x - line, y - line, side + 2 * line, line, color);
  rectangle(x - line, y + side, side + 2 * line, line, color);
  rectangle(x - line, y, line, side, color);
  rectangle(x + side, y, line, side, color);
}

void Canvas::image(const Image& image, double x, double y, double side) {
  const std::unique_ptr<cairo_surface_t, Destroy> surface(surface_of(image));
  const double scale = side / std::max(image.width, image.height);
  cairo_save(context_.get());
  cairo_translate(context_.get(), x, y);
  cairo_scale(context_.get(), scale, scale);
  cairo_set_source_surface(context_.get(), surface.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_.get()), CAIRO_FILTER_BEST);
  // Beyond its edge the picture goes on with its last pixels: the edge stays sharp when scaled.
  cairo_pattern_set_extend(cairo_get_source(context_.get()), CAIRO_EXTEND_PAD);
  cairo_rectangle(context_.get(), 0, 0, image.width, image.height);
  cairo_fill(context_.get());
  cairo_restore(context_.get());
}

void Canvas::text(double x, double y, std::string_view text, Font font, Rgb color, Align align) {
  if (align != Align::left) {
    x -= text_width(text, font) * (align == Align::center ? 0.5 : 1);
  }
  this->font(font);
  this->color(color);
  cairo_move_to(context_.get(), x, y);
  cairo_show_text(context_.get(), std::string(text).c_str());
}

double Canvas::text_width(std::string_view text, Font font) {
  this->font(font);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), std::string(text).c_str(), &extents);
  return extents.x_advance;
}

Image Canvas::finished() const {
  require_success(cairo_status(context_.get()));
  return image_of(surface_.get());
}

void Canvas::color(Rgb color) {
  cairo_set_source_rgb(context_.get(), color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

void Canvas::font(Font font) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), font.size);
}

}  // namespace wordgaze::draw
