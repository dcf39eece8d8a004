#include "wordgaze/lcm/log_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace wordgaze::lcm_io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::runtime_error(fmt::format("cannot write the LCM log '{}': {}", path.string(),
                                       std::generic_category().message(errno)));
}

}  // namespace

struct LogWriter::Log {
  std::filesystem::path path;
  lcm::LogFile file;
};

LogWriter::LogWriter(const std::filesystem::path& path, Origin origin, int every, Mode mode)
    : MessageObserver(std::move(origin), every),
      log_(new Log{path, {path.string(), mode == Mode::create ? "w" : "a"}}) {
  if (!log_->file.good()) fail(path);
}

LogWriter::~LogWriter() = default;

void LogWriter::send(std::string_view channel, std::vector<std::uint8_t> bytes,
                     std::int64_t utime) {
  lcm::LogEvent event{};
  event.channel = channel;
  event.timestamp = utime;
  event.datalen = static_cast<std::int32_t>(bytes.size());
  event.data = bytes.data();
  if (log_->file.writeEvent(&event) != 0 || std::fflush(log_->file.getFilePtr()) != 0) {
    fail(log_->path);
  }
}

}  // namespace wordgaze::lcm_io
