#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/lcm/message_observer.hpp"

namespace wordgaze::lcm_io {

/// Writes a standard LCM log (lcm-logplayer, lcm-spy and the Python package read it), without any
/// network and without loss: each message is in the file when the call returns. Where a message
/// cannot be written (a full disk) the log ends with the last whole one: see problem().
class LogWriter final : public MessageObserver {
 public:
  /// Logs every `every`-th episode and all metrics. A log that stands there is replaced, or, with
  /// the number of the last `update` that a checkpoint knows, gone on with: it is cut behind the
  /// metrics of that update, for a run that was interrupted may have written more, and what follows
  /// is numbered on from there. A file that is not there or empty is started.
  ///
  /// Throws std::runtime_error when the file cannot be opened, when another process is writing it,
  /// when it is no LCM log, and, to go on with, when it is the log of another run or damaged
  /// before its end; the file is then unchanged.
  LogWriter(const std::filesystem::path& path, Origin origin, int every = 1,
            std::optional<std::int64_t> update = {});
  ~LogWriter() override;

  /// What a log that is gone on with lacks of the updates before; empty when nothing. To be told
  /// once.
  const std::string& gap() const;
  /// Why nothing is written any more; empty when all is well. To be told once.
  const std::string& problem() const;
  /// Messages that were not written.
  std::int64_t lost() const;

 private:
  void send(std::string_view channel, std::vector<std::uint8_t> bytes, std::int64_t utime) override;

  struct Log;
  std::unique_ptr<Log> log_;
};

}  // namespace wordgaze::lcm_io
