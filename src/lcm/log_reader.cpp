#include "wordgaze/lcm/log_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "event_log.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/lcm/origin.hpp"

namespace wordgaze::lcm_io {
namespace {

/// Turns the messages of a log back into records.
class Replay {
 public:
  Replay(policy::Observer& observer, LogSummary& summary)
      : observer_(&observer), summary_(&summary) {}

  void tell(std::string_view channel, std::span<const std::uint8_t> bytes) {
    if (channel == kEpisodeBeginChannel) {
      hear<episode_begin_t>(bytes);
    } else if (channel == kWorldChannel) {
      hear<world_t>(bytes);
    } else if (channel == kProgressChannel) {
      hear<progress_t>(bytes);
    } else if (channel == kStepChannel) {
      hear<step_t>(bytes);
    } else if (channel == kEpisodeEndChannel) {
      hear<episode_end_t>(bytes);
    } else if (channel == kMetricsChannel) {
      hear<metrics_t>(bytes);
    }
  }

 private:
  /// An episode that has begun and not ended.
  struct Open {
    int words = 0;
    bool wanted = false;
    std::optional<world_t> world{};
    std::optional<progress_t> progress{};
  };

  template <class Message>
  void hear(std::span<const std::uint8_t> bytes) {
    try {
      tell(decode<Message>(bytes));
      ++summary_->messages;
    } catch (const std::runtime_error&) {
      ++summary_->refused;
    }
  }

  static void expect(bool ok) {
    if (!ok) throw std::runtime_error("a message that no sender of ours sends");
  }
  Open* find(std::int64_t episode) {
    const auto found = open_.find(episode);
    if (found != open_.end()) return &found->second;
    ++summary_->orphans;
    return nullptr;
  }
  void run(const std::string& run_id) {
    if (std::exchange(run_id_, run_id) != run_id || !begun_) observer_->on_run(run_id_);
    begun_ = true;
  }

  void tell(const episode_begin_t& m) {
    babyai::Sentence sentence;
    expect(m.num_tokens <= babyai::kMaxMissionWords);
    for (const std::int32_t id : m.token_ids) {
      expect(id > 0 && id < babyai::kVocabularySize);
      sentence.append(static_cast<babyai::WordId>(id), 0);
    }
    ++summary_->episodes;
    run(m.run_id);
    Open& open = open_[m.episode_id] = {.words = sentence.length,
                                        .wanted = observer_->wants_episode(m.episode_id)};
    if (!open.wanted) return;
    observer_->on_begin({.episode = m.episode_id,
                         .lane = m.env_index,
                         .env_id = m.env_id,
                         .seed = static_cast<std::uint64_t>(m.seed),
                         .sentence = sentence,
                         .mission = m.mission,
                         .max_steps = m.max_steps});
  }

  void tell(const world_t& m) {
    expect(m.width > 0 && m.height > 0 && m.num_bytes == 3 * m.width * m.height);
    if (Open* open = find(m.episode_id)) open->world = m;
  }
  void tell(const progress_t& m) {
    if (Open* open = find(m.episode_id)) open->progress = m;
  }

  void tell(const step_t& m) {
    Open* open = find(m.episode_id);
    if (open == nullptr || !open->wanted) return;
    expect((m.num_tokens == 0 || m.num_tokens == open->words) && m.action >= 0 &&
           m.action < std::max(m.num_actions, 1) && m.num_actions <= grid::kActions);
    tell_scene(m, *open);
    std::array<std::uint8_t, grid::kImageBytes> image;
    std::ranges::copy(m.image, image.begin());
    std::vector<float> maps;
    for (const auto& map : m.word_attention) maps.insert(maps.end(), map.begin(), map.end());
    policy::StepRecord record{.episode = m.episode_id,
                              .lane = m.env_index,
                              .step = m.step,
                              .image = image,
                              .direction = m.direction,
                              .agent_x = m.agent_x,
                              .agent_y = m.agent_y,
                              .action = m.action,
                              .value = m.value,
                              .entropy = m.entropy,
                              .reward = m.reward,
                              .terminated = m.terminated != 0,
                              .truncated = m.truncated != 0,
                              .logits = m.logits,
                              .word_weights = m.word_weights,
                              .word_mask = m.word_mask,
                              .word_attention = maps};
    if (m.num_tokens > 0) {
      record.attention_map = m.attention_map;
      if (knows_nowhere(maps)) record.nowhere = std::max(0.0f, 1 - sum(m.attention_map));
    }
    observer_->on_step(record);
  }

  static float sum(std::span<const float> shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0f);
  }
  /// Whether the maps of the words leave something of 1: what they do is on nowhere.
  static bool knows_nowhere(std::span<const float> maps) {
    for (; !maps.empty(); maps = maps.subspan(grid::kViewCells)) {
      if (sum(maps.first(grid::kViewCells)) < 0.999f) return true;
    }
    return false;
  }

  void tell_scene(const step_t& m, Open& open) {
    const auto world = std::exchange(open.world, std::nullopt);
    const auto progress = std::exchange(open.progress, std::nullopt);
    if (!world || world->step != m.step || !observer_->wants_scenes()) return;
    policy::SceneRecord record{.episode = m.episode_id,
                               .lane = m.env_index,
                               .step = m.step,
                               .width = world->width,
                               .height = world->height,
                               .cells = world->cells,
                               .agent_x = world->agent_x,
                               .agent_y = world->agent_y,
                               .direction = world->direction};
    std::ranges::copy(world->carried, record.carried.begin());
    std::vector<std::uint8_t> completed, enabled;
    std::vector<grid::Position> targets;
    if (progress && progress->step == m.step) {
      completed.assign(progress->completed.begin(), progress->completed.end());
      enabled.assign(progress->enabled.begin(), progress->enabled.end());
      for (std::size_t i = 0; i < progress->target_x.size(); ++i) {
        targets.push_back(grid::at(progress->target_x[i], progress->target_y[i]));
      }
      record.completion = completed;
      record.enabled = enabled;
      record.targets = targets;
      if (progress->num_tokens == open.words) record.sub_task_of = progress->sub_task_of;
    }
    observer_->on_scene(record);
  }

  void tell(const episode_end_t& m) {
    const Open* open = find(m.episode_id);
    if (open == nullptr) return;
    if (open->wanted) {
      observer_->on_end({.episode = m.episode_id,
                         .lane = m.env_index,
                         .steps = m.num_steps,
                         .episode_return = m.episode_return,
                         .success = m.success != 0,
                         .truncated = m.truncated != 0});
    }
    open_.erase(m.episode_id);
  }

  void tell(const metrics_t& m) {
    run(m.run_id);
    std::vector<policy::Scalar> scalars;
    for (std::size_t i = 0; i < m.name.size(); ++i) scalars.push_back({m.name[i], m.value[i]});
    observer_->on_update({.update = m.update, .frames = m.frames, .scalars = scalars});
  }

  policy::Observer* observer_;
  LogSummary* summary_;
  std::string run_id_;
  bool begun_ = false;
  std::map<std::int64_t, Open> open_;
};

}  // namespace

LogSummary replay_log(const std::filesystem::path& path, policy::Observer& observer) {
  constexpr std::uint64_t kMost = 16 * 1024 * 1024;  // bytes of a message; ours are far smaller
  const EventLog log = EventLog::to_read(path);
  LogSummary summary;
  Replay replay(observer, summary);
  std::uint64_t place = 0;
  while (const auto event = log.event_at(place)) {
    place = event->end;
    ++summary.events;
    if (event->data_size() <= kMost) replay.tell(event->channel, log.data(*event));
  }
  if (summary.events == 0) {
    throw std::runtime_error(fmt::format(
        "'{}' holds no event of LCM; expected a log of --lcm-log or lcm-logger", path.string()));
  }
  summary.unread = log.size() - place;
  return summary;
}

}  // namespace wordgaze::lcm_io
