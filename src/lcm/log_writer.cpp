#include "wordgaze/lcm/log_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "event_log.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze::lcm_io {
namespace {

[[noreturn]] void refuse(const EventLog& log, std::string_view cause) {
  throw std::runtime_error(fmt::format("the LCM log '{}' {}; it stays as it is: give another file",
                                       log.path().string(), cause));
}

/// The message of an event; nothing when the event is of another kind or does not decode.
template <class Message>
std::optional<Message> message_in(const EventLog& log, const EventLog::Event& event,
                                  std::string_view channel) {
  constexpr std::uint64_t kMost = 1 << 20;  // bytes; the largest of ours has some thousand
  if (event.channel != channel || event.data_size() > kMost) return std::nullopt;
  try {
    return decode<Message>(log.data(event));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// What a checkpoint knows of a log: its part up to the metrics of the last such update.
struct Known {
  std::uint64_t end = 0;
  std::int64_t next_number = 0;
  std::int64_t update = 0;                   // that it ends with
  std::optional<std::int64_t> open_episode;  // begun in it and not ended
};

/// Reads a log to its end. Throws unless everything after the known part can be dropped: not events
/// of another run, nor what the checkpoint knows and a damaged place hides.
Known known_part(const EventLog& log, const std::string& run_id, std::int64_t update) {
  Known known;
  std::int64_t next_number = 0;
  std::optional<std::int64_t> open;
  const auto check_run = [&](const std::string& run) {
    if (run != run_id) refuse(log, fmt::format("is of run '{}', this one is '{}'", run, run_id));
  };
  bool past = false;  // whether a later update has begun
  std::uint64_t place = 0;
  while (const auto event = log.event_at(place)) {
    place = event->end;
    next_number = std::max(next_number, event->number + 1);
    if (const auto begin = message_in<episode_begin_t>(log, *event, kEpisodeBeginChannel)) {
      check_run(begin->run_id);
      open = begin->episode_id;
    } else if (message_in<episode_end_t>(log, *event, kEpisodeEndChannel)) {
      open.reset();
    } else if (const auto metrics = message_in<metrics_t>(log, *event, kMetricsChannel)) {
      check_run(metrics->run_id);
      past = past || metrics->update > update;
      if (!past) known = {place, next_number, metrics->update, open};
    }
  }
  if ((place == 0 || known.update != update) && log.has_event_behind(place)) {
    refuse(log, fmt::format("is damaged at byte {}, and more events follow", place));
  }
  if (place == 0 && !log.is_torn_at(0)) refuse(log, "holds no event of LCM");
  return known;
}

}  // namespace

struct LogWriter::Log {
  explicit Log(const std::filesystem::path& path) : events(path) {}

  EventLog events;
  std::int64_t next_number = 0, lost = 0;
  std::string gap, problem;
};

LogWriter::LogWriter(const std::filesystem::path& path, Origin origin, int every,
                     std::optional<std::int64_t> update)
    : MessageObserver(std::move(origin), every), log_(std::make_unique<Log>(path)) {
  EventLog& events = log_->events;
  if (!update) {
    const bool is_log = events.event_at(0) || events.is_torn_at(0);
    if (events.size() > 0 && !is_log) refuse(events, "holds no event of LCM");
    events.cut(0);
    return;
  }
  if (events.size() == 0) return;
  const Known known = known_part(events, run_id(), *update);
  events.cut(known.end);
  log_->next_number = known.next_number;
  if (known.open_episode) is_open(*known.open_episode);
  if (known.update < *update) {
    log_->gap = fmt::format(
        "the LCM log '{}' ends with update {}, the checkpoint is of update {}; "
        "what lies between is missing in the log",
        path.string(), known.update, *update);
  }
}

LogWriter::~LogWriter() = default;

const std::string& LogWriter::gap() const { return log_->gap; }

const std::string& LogWriter::problem() const { return log_->problem; }

std::int64_t LogWriter::lost() const { return log_->lost; }

void LogWriter::send(std::string_view channel, std::vector<std::uint8_t> bytes,
                     std::int64_t utime) {
  if (log_->problem.empty()) {
    const auto error = log_->events.append(log_->next_number, utime, channel, bytes);
    if (!error) {
      ++log_->next_number;
      return;
    }
    // For good: a log with holes in its episodes would be worse than one that ends.
    log_->problem = fmt::format("cannot write the LCM log '{}': {}; going on without it",
                                log_->events.path().string(), error.message());
  }
  ++log_->lost;
}

}  // namespace wordgaze::lcm_io
