#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "guided_environment.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/env/effect.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/grid/observation.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
namespace {

using Env = GuidedEnvironment;

/// state (high, low), increment (high, low), whether half a draw is left, and that half.
using RandomState =
    std::tuple<std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, bool, std::uint32_t>;

RandomState random_state(const Env& env) {
  const core::Rng::State s = env.env().rng().state();
  return {s.state_high, s.state_low, s.increment_high, s.increment_low, s.has_half, s.half};
}

core::Rng rng_of(const RandomState& state) {
  const auto [state_high, state_low, increment_high, increment_low, has_half, half] = state;
  return core::Rng(core::Rng::State{.state_high = state_high,
                                    .state_low = state_low,
                                    .increment_high = increment_high,
                                    .increment_low = increment_low,
                                    .half = half,
                                    .has_half = has_half});
}

grid::Action action_of(const Env& env, std::int64_t action) {
  require(action >= 0 && action < env.env().num_actions(),
          "environment '{}': action {}; expected 0 to {}", env.env().id(), action,
          env.env().num_actions() - 1);
  return static_cast<grid::Action>(action);
}

const grid::World& world_of(const Env& env) { return env.env().world(); }

std::vector<int> tokens(const Env& env) {
  const babyai::Sentence& sentence = env.env().sentence();
  return {sentence.begin(), sentence.end()};
}

std::vector<int> completion(const Env& env) {
  const babyai::Progress progress = env.env().progress();
  const auto done = progress.completion();
  return {done.begin(), done.end()};
}

/// What the reference's Grid.encode() gives: [x][y][type, color, state].
auto encoded_grid(const Env& env) {
  const grid::World& world = world_of(env);
  std::vector<std::uint8_t> cells;
  grid::write_cells(world, cells);
  return array_of(std::move(cells), {static_cast<std::size_t>(world.grid.width()),
                                     static_cast<std::size_t>(world.grid.height()), 3});
}

/// An object as (id, type, color, state, contents), contents as another one or None.
nb::object object_tuple(const grid::World& world, grid::ObjectId id) {
  if (id == grid::kNothing) return nb::none();
  const grid::Object& o = world.object(id);
  return nb::make_tuple(int{id}, static_cast<int>(o.type), static_cast<int>(o.color),
                        static_cast<int>(o.state), object_tuple(world, o.contents));
}

/// ((x, y), object) of each cell that holds something, row by row.
nb::list objects_in_grid(const Env& env) {
  const grid::World& world = world_of(env);
  nb::list objects;
  for (int y = 0; y < world.grid.height(); ++y) {
    for (int x = 0; x < world.grid.width(); ++x) {
      const grid::ObjectId id = world.grid[grid::at(x, y)];
      if (id == grid::kNothing) continue;
      objects.append(nb::make_tuple(nb::make_tuple(x, y), object_tuple(world, id)));
    }
  }
  return objects;
}

nb::list effective(const Env& env) {
  const auto possible = env::effective_actions(env.env());
  nb::list list;
  for (int k = 0; k < env.env().num_actions(); ++k) list.append(possible[k]);
  return list;
}

}  // namespace

void bind_environment(nb::module_& module) {
  nb::class_<Env>(module, "Environment", "One environment, with the expert beside it.")
      .def(nb::init<const babyai::LevelSpec&>(), nb::arg("level"))
      .def(
          "reset",
          [](Env& env, std::string_view digits) {
            const core::Seed seed = core::Seed::parse(digits);
            env.change([&](env::Environment& e) { e.reset(seed); });
          },
          nb::arg("seed"), "Starts an episode from a seed of any size, in decimal digits.")
      .def(
          "reset_from",
          [](Env& env, const RandomState& state) {
            env.change([&](env::Environment& e) { e.reset(rng_of(state)); });
          },
          nb::arg("random_state"), "Starts an episode where a random stream is.")
      .def(
          "step",
          [](Env& env, std::int64_t action) {
            const env::Transition t = env.step(action_of(env, action));
            return std::tuple(t.reward, t.terminated, t.truncated);
          },
          nb::arg("action"), "Returns reward, terminated, truncated.")
      .def(
          "observe",
          [](const Env& env, const Array<std::uint8_t, nb::shape<7, 7, 3>>& image) {
            env.env().observe(span_of(image).first<grid::kImageBytes>());
          },
          nb::arg("image").noconvert(), "Writes the agent's view.")
      .def_prop_rw("random_state", &random_state,
                   [](Env& env, const RandomState& state) { env.set_rng(rng_of(state)); })
      .def_prop_ro("direction", [](const Env& env) { return env.env().direction(); })
      .def_prop_ro("agent",
                   [](const Env& env) {
                     return std::tuple(int{world_of(env).agent.x}, int{world_of(env).agent.y});
                   })
      .def_prop_ro("size",
                   [](const Env& env) {
                     return std::tuple(world_of(env).grid.width(), world_of(env).grid.height());
                   })
      .def_prop_ro("step_count", [](const Env& env) { return env.env().step_count(); })
      .def_prop_ro("max_steps", [](const Env& env) { return env.env().max_steps(); })
      .def_prop_ro("mission", [](const Env& env) { return env.env().mission(); })
      .def_prop_ro("tokens", &tokens, "The ids of the mission's words.")
      .def_prop_ro("completion", &completion, "One 0/1 a sub-task of the mission: done so far.")
      .def_prop_ro(
          "carrying",
          [](const Env& env) { return object_tuple(world_of(env), world_of(env).carried); })
      .def("objects", &objects_in_grid,
           "((x, y), object) of each cell that is not empty, row by row; an object is (id, type, "
           "color, state, contents).")
      .def("encode", &encoded_grid, "The whole grid, [x][y][type, color, state].")
      .def("effective_actions", &effective,
           "One bool an action: whether it would do more now than let time pass.")
      .def(
          "bot_action",
          [](Env& env) -> std::optional<int> {
            const auto action = env.advice();
            return action ? std::optional(static_cast<int>(*action)) : std::nullopt;
          },
          "What BabyAI's expert would do now; None when it has given up.")
      .def("serialize", [](const Env& env) { return bytes_object(env.env().serialize()); })
      .def(
          "restore",
          [](Env& env, const nb::bytes& state) {
            env.change([&](env::Environment& e) { e.restore(span_of(state)); });
          },
          nb::arg("state"))
      .def("__copy__", [](const Env& env) { return env; })
      .def(
          "__deepcopy__", [](const Env& env, const nb::dict&) { return env; }, nb::arg("memo"))
      .def("__getstate__",
           [](const Env& env) {
             return nb::make_tuple(env.env().spec(), bytes_object(env.env().serialize()));
           })
      .def("__setstate__", [](Env& env, const nb::tuple& state) {
        new (&env) Env(nb::cast<babyai::LevelSpec>(state[0]));
        const auto bytes = nb::cast<nb::bytes>(state[1]);
        env.change([&](env::Environment& e) { e.restore(span_of(bytes)); });
      });
}

}  // namespace wordgaze::python
