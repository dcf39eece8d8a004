#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "bindings.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/core/require.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
namespace {

using babyai::LevelSpec;

LevelSpec make_level(std::string_view id, std::optional<int> room_size, std::optional<int> objects,
                     std::optional<int> max_steps, std::optional<bool> see_through_walls) {
  LevelSpec level = babyai::edited(babyai::find_level(id), {room_size, objects});
  if (max_steps) {
    require(*max_steps > 0, "level '{}': max_steps = {}; expected at least 1", id, *max_steps);
    level.max_steps = *max_steps;
  }
  level.see_through_walls = see_through_walls.value_or(level.see_through_walls);
  babyai::validate(level);
  return level;
}

// What the id does not say of a level.
using State = std::tuple<std::string, int, bool>;

}  // namespace

void bind_level(nb::module_& module) {
  nb::class_<LevelSpec>(module, "Level", "A level by its id, and what is changed in it.")
      .def(
          "__init__",
          [](LevelSpec* level, std::string_view id, std::optional<int> room_size,
             std::optional<int> objects, std::optional<int> max_steps,
             std::optional<bool> see_through_walls) {
            new (level) LevelSpec(make_level(id, room_size, objects, max_steps, see_through_walls));
          },
          nb::arg("id"), nb::kw_only(), nb::arg("room_size").none() = nb::none(),
          nb::arg("objects").none() = nb::none(), nb::arg("max_steps").none() = nb::none(),
          nb::arg("see_through_walls").none() = nb::none(),
          "Raises ValueError for an id that is not known and for numbers that do not fit.")
      .def_ro("id", &LevelSpec::id, "The id, which tells the size of rooms and the objects too.")
      .def_ro("actions", &LevelSpec::actions, "The level has so many of the actions.")
      .def_ro("see_through_walls", &LevelSpec::see_through_walls)
      .def("__getstate__",
           [](const LevelSpec& level) {
             return State(level.id, level.max_steps, level.see_through_walls);
           })
      .def("__setstate__", [](LevelSpec& level, const State& state) {
        new (&level) LevelSpec(babyai::find_level(std::get<0>(state)));
        level.max_steps = std::get<1>(state);
        level.see_through_walls = std::get<2>(state);
      });
}

}  // namespace wordgaze::python
