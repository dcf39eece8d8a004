#include "wordgaze/policy/trained_agent.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/io/weights_file.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/policy/network_policy.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
namespace {

using policy::Decision;

/// A decision, and where the agent looked for it.
struct Seen {
  Decision decision;
  std::vector<float> probabilities;
  policy::AttentionRecord attention;
  std::vector<std::string> words;
};

/// A trained agent in one episode.
class Agent {
 public:
  /// The level decides which cells the agent may meet, and which it tells apart.
  Agent(const std::string& path, const std::optional<babyai::LevelSpec>& level, std::uint64_t seed)
      : trained_(policy::TrainedAgent::load(
            path, level ? policy::alphabet_of(*level) : model::CellAlphabet::everything())),
        policy_(trained_),
        rng_(seed) {}

  void begin(std::string_view mission, int actions) {
    policy::Observation observation;
    observation.sentence = babyai::sentence_of(mission);
    observation.actions = actions;
    policy_.observe(0, observation);  // refuses what the agent cannot read
    observation_ = observation;
    policy_.begin(0);
  }

  Seen act(const Array<const std::uint8_t, nb::shape<7, 7, 3>>& image,
           const std::optional<std::vector<int>>& completion, bool sample) {
    require(observation_.has_value(), "Policy.act: no mission yet; call begin(mission) first");
    policy::Observation observation = *observation_;
    std::ranges::copy(span_of(image), observation.image.begin());
    if (completion) {
      require(completion->size() <= observation.completion.size(),
              "Policy.act: completion of {} sub-tasks; expected at most {}", completion->size(),
              observation.completion.size());
      for (std::size_t k = 0; k < completion->size(); ++k) {
        const int done = (*completion)[k];
        require(done == 0 || done == 1, "Policy.act: completion[{}] is {}; expected 0 or 1", k,
                done);
        observation.completion[k] = static_cast<std::uint8_t>(done);
      }
    }
    policy_.observe(0, observation);
    Seen seen;
    seen.decision =
        (sample ? policy_.decide(policy::Sampled{rng_}) : policy_.decide(policy::Greedy{}))[0];
    const auto logits = policy_.logits(0);
    seen.probabilities.resize(logits.size());
    nn::Categorical<float>::log_softmax(logits, std::span(seen.probabilities));
    for (float& p : seen.probabilities) p = std::exp(p);
    policy_.attention(0, seen.attention);
    for (const babyai::WordId id : observation.sentence) {
      seen.words.emplace_back(babyai::word(id));
    }
    return seen;
  }

  bool has_attention() const { return policy_.design().config.attention; }

 private:
  policy::TrainedAgent trained_;
  policy::NetworkPolicy<policy::Agent> policy_;
  core::Rng rng_;
  std::optional<policy::Observation> observation_;
};

/// One number a word.
auto by_word(const std::vector<float>& numbers) { return array_of(numbers, {numbers.size()}); }
/// 49 numbers, or as many a word, laid out as the view; none without attention.
auto as_view(const std::vector<float>& map) { return array_of(map, {map.empty() ? 0u : 7u, 7}); }
auto as_views(const std::vector<float>& maps) {
  return array_of(maps, {maps.size() / grid::kViewCells, 7, 7});
}

}  // namespace

void bind_policy(nb::module_& module) {
  constexpr auto kOwned = nb::rv_policy::automatic;  // by the array that is returned
  nb::class_<Seen>(module, "Decision",
                   "A decision of an agent, and where it looked. Maps lie as the view, [x][y]; "
                   "without attention they are empty.")
      .def_prop_ro("action", [](const Seen& s) { return static_cast<int>(s.decision.action); })
      .def_prop_ro(
          "log_prob", [](const Seen& s) { return s.decision.log_prob; },
          "Logarithm of the probability of the action.")
      .def_prop_ro(
          "entropy", [](const Seen& s) { return s.decision.entropy; }, "Of the policy, in nats.")
      .def_prop_ro(
          "value", [](const Seen& s) { return s.decision.value; },
          "The discounted reward that the critic expects.")
      .def_prop_ro(
          "probabilities", [](const Seen& s) { return by_word(s.probabilities); }, kOwned,
          "One an action.")
      .def_ro("words", &Seen::words, "The words of the mission.")
      .def_prop_ro(
          "weights", [](const Seen& s) { return by_word(s.attention.weights); }, kOwned,
          "How much each word counts, w; sums to 1.")
      .def_prop_ro(
          "mask", [](const Seen& s) { return by_word(s.attention.mask); }, kOwned,
          "What the task mask leaves of each word, alpha.")
      .def_prop_ro(
          "maps", [](const Seen& s) { return as_views(s.attention.maps); }, kOwned,
          "Where each word looks, A: [words, 7, 7].")
      .def_prop_ro(
          "gaze", [](const Seen& s) { return as_view(s.attention.gaze); }, kOwned,
          "Where the agent looks, M: [7, 7].")
      .def_prop_ro(
          "filter", [](const Seen& s) { return as_view(s.attention.filter); }, kOwned,
          "What the view is multiplied with, s(M): [7, 7].")
      .def_prop_ro(
          "nowhere", [](const Seen& s) { return s.attention.nowhere; },
          "What M has outside of the view.");
  module.def(
      "configuration",
      [](const std::string& path) { return io::configuration_text(io::read_weights_file(path)); },
      nb::arg("path"), "The configuration in a file of weights, as TOML.");
  nb::class_<Agent>(module, "Agent", "A trained agent in one episode.")
      .def(nb::init<const std::string&, const std::optional<babyai::LevelSpec>&, std::uint64_t>(),
           nb::arg("path"), nb::arg("level").none(), nb::arg("seed"))
      .def("begin", &Agent::begin, nb::arg("mission"), nb::arg("actions"))
      .def("act", &Agent::act, nb::arg("image"), nb::arg("completion").none() = nb::none(),
           nb::arg("sample") = false)
      .def_prop_ro("has_attention", &Agent::has_attention);
}

}  // namespace wordgaze::python
