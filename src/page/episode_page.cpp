#include "wordgaze/page/episode_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "page_template.hpp"
#include "shares.hpp"
#include "what_if.hpp"
#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/nn/categorical.hpp"

namespace wordgaze::page {
namespace {

using Json = nlohmann::ordered_json;

/// A number to three decimals, which is what is shown; null for what is none.
Json rounded(double number) {
  return std::isfinite(number) ? Json(std::round(1000 * number) / 1000) : Json(nullptr);
}

Json list(std::span<const std::uint8_t> numbers) { return Json(numbers); }

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

struct EpisodePage::Data {
  struct Episode {
    Json json;
    int lane = 0;
    std::vector<std::uint8_t> cells{};  // of the world, as told last
    Json scene{}, what_if{};            // of the coming step
  };

  std::string title;
  int wanted;
  std::string run{};
  int of_run = 0;  // episodes begun of it
  std::set<std::int64_t> begun{};
  std::map<std::int64_t, Episode> open{};
  std::vector<Json> finished{};

  Episode* find(std::int64_t episode) {
    const auto found = open.find(episode);
    return found == open.end() ? nullptr : &found->second;
  }
};

EpisodePage::EpisodePage(std::string title, int episodes)
    : data_(std::make_unique<Data>(Data{.title = std::move(title), .wanted = episodes})) {
  require(episodes > 0, "EpisodePage: {} episodes; expected one or more", episodes);
}

EpisodePage::~EpisodePage() = default;

int EpisodePage::episodes() const {
  return static_cast<int>(data_->finished.size() + data_->open.size());
}

void EpisodePage::on_run(std::string_view run_id) {
  data_->run = run_id;
  data_->of_run = 0;
}

bool EpisodePage::wants_episode(std::int64_t episode) {
  return data_->open.contains(episode) || data_->of_run < data_->wanted;
}

void EpisodePage::on_begin(const policy::EpisodeBegin& begin) {
  if (data_->of_run >= data_->wanted) return;
  ++data_->of_run;
  Json words = Json::array();
  for (const babyai::WordId id : begin.sentence) words.push_back(babyai::word(id));
  data_->open[begin.episode] = {.json = {{"id", begin.episode},
                                         {"run", data_->run},
                                         {"env", begin.env_id},
                                         {"seed", std::to_string(begin.seed)},
                                         {"mission", begin.mission},
                                         {"words", std::move(words)},
                                         {"max_steps", begin.max_steps},
                                         {"steps", Json::array()}},
                                .lane = begin.lane};
}

void EpisodePage::on_decision(const evaluation::DecisionContext& context) {
  // Lanes are numbered alike by who decides and by who reports.
  for (auto& [id, episode] : data_->open) {
    if (episode.lane == context.lane) episode.what_if = what_if(context);
  }
}

void EpisodePage::on_scene(const policy::SceneRecord& scene) {
  Data::Episode* episode = data_->find(scene.episode);
  if (episode == nullptr) return;
  Json& json = episode->scene = Json::object();
  if (!std::ranges::equal(scene.cells, episode->cells)) {  // most steps leave the world as it is
    episode->cells.assign(scene.cells.begin(), scene.cells.end());
    json["size"] = {scene.width, scene.height};
    json["cells"] = base64(scene.cells);
  }
  json["carried"] = list(scene.carried);
  json["done"] = list(scene.completion);
  json["turn"] = list(scene.enabled);
  Json targets = Json::array();
  for (const grid::Position p : scene.targets) targets.push_back({p.x, p.y});
  json["targets"] = std::move(targets);
  if (!scene.sub_task_of.empty()) episode->json["sub_task_of"] = scene.sub_task_of;
}

void EpisodePage::on_step(const policy::StepRecord& step) {
  Data::Episode* episode = data_->find(step.episode);
  if (episode == nullptr) return;
  Json json = std::exchange(episode->scene, Json::object());
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
  if (!episode->what_if.is_null()) json["what_if"] = std::exchange(episode->what_if, Json());
  episode->json["steps"].push_back(std::move(json));
}

void EpisodePage::on_end(const policy::EpisodeEnd& end) {
  Data::Episode* episode = data_->find(end.episode);
  if (episode == nullptr) return;
  episode->json["success"] = end.success;
  episode->json["truncated"] = end.truncated;
  episode->json["return"] = rounded(end.episode_return);
  data_->finished.push_back(std::move(episode->json));
  data_->open.erase(end.episode);
}

std::string EpisodePage::html() const {
  Json episodes = data_->finished;
  for (const auto& [id, episode] : data_->open) episodes.push_back(episode.json);
  const auto before = [](const Json& a, const Json& b) { return a["id"] < b["id"]; };
  std::stable_sort(episodes.begin(), episodes.end(), before);
  Json actions = Json::array();
  for (const auto name : grid::kActionNames) actions.push_back(name);
  const Json data{{"format", 1},
                  {"title", data_->title},
                  {"actions", std::move(actions)},
                  {"types", grid::kTypeNames},
                  {"colors", grid::kColorNames},
                  {"episodes", std::move(episodes)}};
  std::string page(kPage);
  replace(page, "{{title}}", escaped(data_->title));
  replace(page, "{{episodes}}", embedded(data));
  return page;
}

void EpisodePage::write(const std::filesystem::path& path) const { io::write_file(path, html()); }

}  // namespace wordgaze::page
