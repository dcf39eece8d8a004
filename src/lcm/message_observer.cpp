#include "wordgaze/lcm/message_observer.hpp"

#include <utility>

#include "clock.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/lcm/convert.hpp"

namespace wordgaze::lcm_io {
MessageObserver::MessageObserver(Origin origin, int every)
    : origin_(std::move(origin)), every_(every) {
  require(every > 0, "LCM: expected every k-th episode with k above 0; came {}", every);
}

void MessageObserver::on_begin(const policy::EpisodeBegin& record) {
  if (!wants_episode(record.episode)) return;
  if (record.steps > 0 && record.episode == open_episode_) return;
  const std::int64_t now = now_utime();
  send(kEpisodeBeginChannel, encode(to_message(record, origin_, now)), now);
}

void MessageObserver::on_scene(const policy::SceneRecord& record) {
  if (!wants_episode(record.episode)) return;
  const std::int64_t now = now_utime();
  send(kWorldChannel, encode(to_world_message(record, now)), now);
  send(kProgressChannel, encode(to_progress_message(record, now)), now);
}

void MessageObserver::on_step(const policy::StepRecord& record) {
  if (!wants_episode(record.episode)) return;
  const std::int64_t now = now_utime();
  send(kStepChannel, encode(to_message(record, now)), now);
}

void MessageObserver::on_end(const policy::EpisodeEnd& record) {
  if (!wants_episode(record.episode)) return;
  const std::int64_t now = now_utime();
  send(kEpisodeEndChannel, encode(to_message(record, now)), now);
}

void MessageObserver::on_update(const policy::UpdateRecord& record) {
  const std::int64_t now = now_utime();
  send(kMetricsChannel, encode(to_message(record, origin_, now)), now);
}

}  // namespace wordgaze::lcm_io
