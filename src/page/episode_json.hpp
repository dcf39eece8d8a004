#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::page {

using Json = nlohmann::ordered_json;

/// The records of episodes as the pages want them; the fields are in docs/formats.md. Knows the
/// episodes that have begun and not ended; of others it says nothing.
class EpisodeJson {
 public:
  void on_run(std::string_view run_id) { run_ = run_id; }
  bool is_open(std::int64_t episode) const { return open_.contains(episode); }

  Json begin(const policy::EpisodeBegin& begin);
  /// Asks the network what it would do otherwise, if an episode of this lane is open.
  void decision(const evaluation::DecisionContext& context);
  void scene(const policy::SceneRecord& scene);
  std::optional<Json> step(const policy::StepRecord& step);
  std::optional<Json> end(const policy::EpisodeEnd& end);

 private:
  struct Open {
    int lane = 0;
    std::vector<std::uint8_t> cells{};  // of the world, as told last
    Json scene = Json::object();        // of the coming step
    Json what_if{};
  };
  std::string run_;
  std::map<std::int64_t, Open> open_;
};

/// A page with this data in it.
std::string page_with(std::string_view title, Json data);

}  // namespace wordgaze::page
