#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "pixels.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/core/team.hpp"
#include "wordgaze/draw/tile.hpp"
#include "wordgaze/env/effect.hpp"
#include "wordgaze/env/vector_env.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
namespace {

using Bytes = Array<std::uint8_t, nb::ndim<1>>;
using Images = Array<std::uint8_t, nb::shape<-1, 7, 7, 3>>;
using Numbers = Array<double, nb::ndim<1>>;
using Flags = Array<bool, nb::ndim<1>>;
using Actions = Array<const std::int64_t, nb::ndim<1>>;
using Tokens = Array<std::uint8_t, nb::ndim<2>>;
using Seeds = std::vector<std::optional<std::string>>;

/// Environments with the threads that step them. Calls from several threads come one after the
/// other.
class Batch {
 public:
  Batch(const babyai::LevelSpec& level, int size, int threads)
      : team_(threads), env_(level, size, team_), actions_(static_cast<std::size_t>(size)) {}

  const env::VectorEnv& env() const { return env_; }
  int size() const { return env_.size(); }

  void reset(const Seeds& seeds, const std::optional<Flags>& chosen, const Images& images,
             const Bytes& directions) {
    std::vector<std::optional<core::Seed>> parsed;
    for (const auto& seed : seeds) {
      parsed.push_back(seed ? std::optional(core::Seed::parse(*seed)) : std::nullopt);
    }
    const env::BatchOutput out{.images = span_of(images), .directions = span_of(directions)};
    const auto which = chosen ? bytes_of(*chosen) : std::span<std::uint8_t>{};
    alone([&] { env_.reset(parsed, out, which); });
  }

  void observe(const Images& images, const Bytes& directions) const {
    env_.observe({.images = span_of(images), .directions = span_of(directions)});
  }

  /// Whether an episode has ended.
  bool step(const Actions& actions, const Images& images, const Bytes& directions,
            const Numbers& rewards, const Flags& terminated, const Flags& truncated,
            const Images& final_images, const Bytes& final_directions) {
    const env::BatchOutput out{.images = span_of(images),
                               .directions = span_of(directions),
                               .rewards = span_of(rewards),
                               .terminated = bytes_of(terminated),
                               .truncated = bytes_of(truncated),
                               .final_images = span_of(final_images),
                               .final_directions = span_of(final_directions)};
    const auto given = span_of(actions);
    bool ended = false;
    alone([&] {
      take(given);
      env_.step(actions_, out);
      const auto has_one = [](auto flags) { return std::ranges::find(flags, 1) != flags.end(); };
      ended = has_one(out.terminated) || has_one(out.truncated);
    });
    return ended;
  }

  /// Writes the words of missions, padded, and how many they are: of all, or of those chosen.
  void write_missions(const Tokens& tokens, const Bytes& lengths,
                      const std::optional<Flags>& chosen) const {
    const auto n = static_cast<std::size_t>(size());
    require(tokens.shape(0) == n && lengths.size() == n && (!chosen || chosen->size() == n),
            "write_missions: expected arrays of {} rows", n);
    const std::size_t width = tokens.shape(1);
    const auto all = span_of(tokens);
    for (std::size_t k = 0; k < n; ++k) {
      if (chosen && !chosen->data()[k]) continue;
      const babyai::Sentence& sentence = env_[static_cast<int>(k)].sentence();
      const auto length = static_cast<std::size_t>(sentence.length);
      require(length <= width,
              "mission '{}' has {} words, which is more than max_words = {}; ask for more",
              babyai::text(sentence), length, width);
      const auto row = all.subspan(k * width, width);
      std::ranges::fill(std::ranges::copy(sentence, row.begin()).out, row.end(), babyai::kPadding);
      lengths.data()[k] = static_cast<std::uint8_t>(length);
    }
  }

  void write_masks(const Array<bool, nb::ndim<2>>& masks) const {
    const auto actions = static_cast<std::size_t>(env_[0].num_actions());
    require(masks.shape(0) == static_cast<std::size_t>(size()) && masks.shape(1) == actions,
            "write_masks: expected an array of {} x {}", size(), actions);
    for (int k = 0; k < size(); ++k) {
      const auto effective = env::effective_actions(env_[k]);
      std::copy_n(effective.begin(), actions, masks.data() + static_cast<std::size_t>(k) * actions);
    }
  }

  nb::bytes serialize(int k) const { return bytes_object(at(k).serialize()); }
  void restore(int k, const nb::bytes& state) { env_.restore(k, span_of(state)); }
  const env::Environment& at(int k) const {
    require(k >= 0 && k < size(), "environment {} of {}", k, size());
    return env_[k];
  }

 private:
  /// Without Python's lock.
  template <class Call>
  void alone(Call call) {
    const nb::gil_scoped_release release;
    const std::scoped_lock lock(mutex_);
    call();
  }
  void take(std::span<const std::int64_t> given) {
    require(given.size() == actions_.size(), "step: {} actions for {} environments", given.size(),
            actions_.size());
    const int count = env_[0].num_actions();
    for (std::size_t k = 0; k < given.size(); ++k) {
      require(given[k] >= 0 && given[k] < count,
              "step: action {} of environment {}; expected 0 to {}", given[k], k, count - 1);
      actions_[k] = static_cast<grid::Action>(given[k]);
    }
  }

  Team team_;
  env::VectorEnv env_;
  std::vector<grid::Action> actions_;
  std::mutex mutex_;
};

}  // namespace

void bind_vector_env(nb::module_& module) {
  nb::class_<Batch>(module, "Batch",
                    "Environments of one level that step together, on some threads. An environment "
                    "whose episode ends starts the next one in the same step.")
      .def(nb::init<const babyai::LevelSpec&, int, int>(), nb::arg("level"), nb::arg("num_envs"),
           nb::arg("num_threads"))
      .def("reset", &Batch::reset, nb::arg("seeds"), nb::arg("chosen").none(),
           nb::arg("images").noconvert(), nb::arg("directions").noconvert(),
           "Starts each from its seed (decimal digits), or where its random stream is (None).")
      .def("step", &Batch::step, nb::arg("actions").noconvert(), nb::arg("images").noconvert(),
           nb::arg("directions").noconvert(), nb::arg("rewards").noconvert(),
           nb::arg("terminated").noconvert(), nb::arg("truncated").noconvert(),
           nb::arg("final_images").noconvert(), nb::arg("final_directions").noconvert(),
           "One step of each, written into the arrays; whether an episode has ended.")
      .def("observe", &Batch::observe, nb::arg("images").noconvert(),
           nb::arg("directions").noconvert())
      .def("write_missions", &Batch::write_missions, nb::arg("tokens").noconvert(),
           nb::arg("lengths").noconvert(), nb::arg("chosen").none())
      .def("write_masks", &Batch::write_masks, nb::arg("masks").noconvert())
      .def(
          "mission", [](const Batch& batch, int k) { return batch.at(k).mission(); }, nb::arg("k"))
      .def(
          "frame",
          [](const Batch& batch, int k, draw::TileRenderer& renderer) {
            return pixels(renderer.world(batch.at(k).world()));
          },
          nb::arg("k"), nb::arg("renderer"), "The world of environment k in pixels.")
      .def("serialize", &Batch::serialize, nb::arg("k"))
      .def("restore", &Batch::restore, nb::arg("k"), nb::arg("state"));
}

}  // namespace wordgaze::python
