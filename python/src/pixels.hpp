#pragma once
#include <cstddef>
#include <utility>

#include "arrays.hpp"
#include "wordgaze/draw/image.hpp"

namespace wordgaze::python {

/// An image as NumPy's [height, width, 3].
inline auto pixels(draw::Image image) {
  const auto height = static_cast<std::size_t>(image.height);
  const auto width = static_cast<std::size_t>(image.width);
  return array_of(std::move(image.rgb), {height, width, 3});
}

}  // namespace wordgaze::python
