#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "wordgaze/lcm/message_observer.hpp"

namespace wordgaze::lcm_io {

/// Writes a standard LCM log (lcm-logplayer, lcm-spy and the Python package read it), without any
/// network and without loss: each message is in the file when the call returns.
class LogWriter final : public MessageObserver {
 public:
  enum class Mode { create, append };

  /// Logs every `every`-th episode and all metrics. Throws std::runtime_error when the file cannot
  /// be opened; so does every later call that cannot write.
  LogWriter(const std::filesystem::path& path, Origin origin, int every = 1,
            Mode mode = Mode::create);
  ~LogWriter() override;

 private:
  void send(std::string_view channel, std::vector<std::uint8_t> bytes, std::int64_t utime) override;

  struct Log;
  std::unique_ptr<Log> log_;
};

}  // namespace wordgaze::lcm_io
