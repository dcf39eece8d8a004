#include <nanobind/nanobind.h>

#include <cstdint>

#include "arrays.hpp"
#include "bindings.hpp"
#include "guided_environment.hpp"
#include "pixels.hpp"
#include "wordgaze/draw/tile.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
void bind_tiles(nb::module_& module) {
  nb::class_<draw::TileRenderer>(module, "TileRenderer",
                                 "MiniGrid's look, byte for byte; each different tile is drawn "
                                 "once.")
      .def(nb::init<int>(), nb::arg("tile_size"))
      .def(
          "world",
          [](draw::TileRenderer& renderer, const GuidedEnvironment& env, bool highlight) {
            return pixels(renderer.world(env.env().world(), highlight));
          },
          nb::arg("env"), nb::arg("highlight") = true, "The whole grid with the agent.")
      .def(
          "view",
          [](draw::TileRenderer& renderer,
             const Array<const std::uint8_t, nb::shape<7, 7, 3>>& image) {
            return pixels(renderer.view(span_of(image).first<grid::kImageBytes>()));
          },
          nb::arg("image"), "What the agent sees.");
}

}  // namespace wordgaze::python
