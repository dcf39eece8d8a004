#pragma once
#include <cairo.h>

#include <memory>
#include <string_view>

#include "palette.hpp"
#include "wordgaze/draw/image.hpp"

/// What figures are drawn with: Cairo on a white sheet, in pixels from the top left.
namespace wordgaze::draw {

enum class Align { left, center, right };
struct Font {
  double size = 15;
  bool bold = false;
};

class Canvas {
 public:
  Canvas(int width, int height);

  void rectangle(double x, double y, double width, double height, Rgb color);
  /// Four lines of width `line` around a square; they lie outside of it.
  void frame(double x, double y, double side, double line, Rgb color);
  /// As large as fits a square of `side` pixels.
  void image(const Image& image, double x, double y, double side);
  /// `y` is the base line.
  void text(double x, double y, std::string_view text, Font font, Rgb color = kInk,
            Align align = Align::left);
  double text_width(std::string_view text, Font font);

  /// The sheet as it is now. Throws std::runtime_error when drawing failed.
  Image finished() const;

 private:
  void color(Rgb color);
  void font(Font font);

  struct Destroy {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
  };
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

/// A Cairo surface with the pixels of an image, and back.
cairo_surface_t* surface_of(const Image& image);
Image image_of(cairo_surface_t* surface);
/// Throws std::runtime_error unless the status is success.
void require_success(cairo_status_t status);

}  // namespace wordgaze::draw
