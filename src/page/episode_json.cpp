#include "episode_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "page_template.hpp"
#include "shares.hpp"
#include "what_if.hpp"
#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::page {
namespace {

/// A number to three decimals, which is what is shown; null for what is none.
Json rounded(double number) {
  return std::isfinite(number) ? Json(std::round(1000 * number) / 1000) : Json(nullptr);
}

std::string probabilities(std::span<const float> logits) {
  std::vector<float> numbers(logits.size());
  nn::Categorical<float>::log_softmax(logits, numbers);
  for (float& number : numbers) number = std::exp(number);
  return shares(numbers);
}

/// As text that can stand in an HTML page: no "</script>" ends it early.
std::string embedded(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find("</", at)) != text.npos; at += 3)
    text.insert(at + 1, 1, '\\');
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// Puts a text in the place of each mark.
void replace(std::string& page, std::string_view mark, const std::string& text) {
  for (std::size_t at = 0; (at = page.find(mark, at)) != page.npos; at += text.size()) {
    page.replace(at, mark.size(), text);
  }
}

}  // namespace

Json EpisodeJson::begin(const policy::EpisodeBegin& begin) {
  Json words = Json::array();
  for (const babyai::WordId id : begin.sentence) words.push_back(babyai::word(id));
  open_[begin.episode] = {.lane = begin.lane};
  return {{"id", begin.episode},         {"run", run_},
          {"env", begin.env_id},         {"seed", std::to_string(begin.seed)},
          {"mission", begin.mission},    {"words", std::move(words)},
          {"max_steps", begin.max_steps}};
}

void EpisodeJson::decision(const evaluation::DecisionContext& context) {
  // Lanes are numbered alike by who decides and by who reports.
  for (auto& [id, episode] : open_) {
    if (episode.lane == context.lane) episode.what_if = what_if(context);
  }
}

void EpisodeJson::scene(const policy::SceneRecord& scene) {
  const auto open = open_.find(scene.episode);
  if (open == open_.end()) return;
  Json& json = open->second.scene = Json::object();
  auto& cells = open->second.cells;
  if (!std::ranges::equal(scene.cells, cells)) {  // most steps leave the world as it is
    cells.assign(scene.cells.begin(), scene.cells.end());
    json["size"] = {scene.width, scene.height};
    json["cells"] = base64(scene.cells);
  }
  json["carried"] = scene.carried;
  json["done"] = scene.completion;
  json["turn"] = scene.enabled;
  Json targets = Json::array();
  for (const grid::Position p : scene.targets) targets.push_back({p.x, p.y});
  json["targets"] = std::move(targets);
  if (!scene.sub_task_of.empty()) json["sub_task_of"] = scene.sub_task_of;
}

std::optional<Json> EpisodeJson::step(const policy::StepRecord& step) {
  const auto open = open_.find(step.episode);
  if (open == open_.end()) return std::nullopt;
  Json json = std::exchange(open->second.scene, Json::object());
  json["step"] = step.step;
  json["at"] = {step.agent_x, step.agent_y, step.direction};
  json["image"] = base64(step.image);
  json["action"] = step.action;
  json["value"] = rounded(step.value);
  json["reward"] = rounded(step.reward);
  if (!step.logits.empty()) json["policy"] = probabilities(step.logits);
  if (!step.word_weights.empty()) {
    json["weights"] = shares(step.word_weights);
    json["mask"] = shares(step.word_mask);
    json["maps"] = shares(step.word_attention);
  }
  if (!step.attention_map.empty()) {
    json["gaze"] = shares(step.attention_map);
    json["nowhere"] = rounded(step.nowhere);
  }
  if (!step.filter.empty()) json["filter"] = shares(step.filter);
  if (auto& what_if = open->second.what_if; !what_if.is_null()) {
    json["what_if"] = std::exchange(what_if, Json());
  }
  return json;
}

std::optional<Json> EpisodeJson::end(const policy::EpisodeEnd& end) {
  if (open_.erase(end.episode) == 0) return std::nullopt;
  return Json{{"success", end.success},
              {"truncated", end.truncated},
              {"return", rounded(end.episode_return)}};
}

std::string page_with(std::string_view title, Json data) {
  data["format"] = 1;
  data["title"] = title;
  data["actions"] = grid::kActionPhrases;
  data["types"] = grid::kTypeNames;
  data["colors"] = grid::kColorNames;
  std::string page(kPage);
  replace(page, "{{title}}", escaped(title));
  replace(page, "{{episodes}}", embedded(data));
  return page;
}

}  // namespace wordgaze::page
