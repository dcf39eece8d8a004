#include "wordgaze/page/episode_page.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "episode_json.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::page {

struct EpisodePage::Data {
  std::string title;
  int wanted;
  int of_run = 0;  // episodes begun of the run
  EpisodeJson json{};
  std::map<std::int64_t, Json> open{};
  std::vector<Json> finished{};
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
  data_->json.on_run(run_id);
  data_->of_run = 0;
}

bool EpisodePage::wants_episode(std::int64_t episode) {
  return data_->json.is_open(episode) || data_->of_run < data_->wanted;
}

void EpisodePage::on_begin(const policy::EpisodeBegin& begin) {
  if (data_->of_run >= data_->wanted) return;
  ++data_->of_run;
  Json& episode = data_->open[begin.episode] = data_->json.begin(begin);
  episode["steps"] = Json::array();
}

void EpisodePage::on_decision(const evaluation::DecisionContext& context) {
  data_->json.decision(context);
}

void EpisodePage::on_scene(const policy::SceneRecord& scene) { data_->json.scene(scene); }

void EpisodePage::on_step(const policy::StepRecord& step) {
  if (auto json = data_->json.step(step)) {
    data_->open.at(step.episode)["steps"].push_back(*std::move(json));
  }
}

void EpisodePage::on_end(const policy::EpisodeEnd& end) {
  const auto json = data_->json.end(end);
  if (!json) return;
  const auto open = data_->open.find(end.episode);
  open->second.update(*json);
  data_->finished.push_back(std::move(open->second));
  data_->open.erase(open);
}

std::string EpisodePage::html() const {
  Json episodes = data_->finished;
  for (const auto& [id, episode] : data_->open) episodes.push_back(episode);
  const auto before = [](const Json& a, const Json& b) { return a["id"] < b["id"]; };
  std::stable_sort(episodes.begin(), episodes.end(), before);
  return page_with(data_->title, {{"episodes", std::move(episodes)}});
}

void EpisodePage::write(const std::filesystem::path& path) const { io::write_file(path, html()); }

}  // namespace wordgaze::page
