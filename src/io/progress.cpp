#include "wordgaze/io/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wordgaze/core/require.hpp"
#include "wordgaze/io/standard_streams.hpp"

namespace wordgaze::io {
namespace {

/// Columns of the terminal; a longer line would wrap and could not be rewritten.
std::size_t width(std::FILE* terminal) {
  winsize size{};
  const bool known = ::ioctl(::fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::round(seconds));
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

Progress::Progress(std::string unit, std::int64_t done, std::int64_t total, Options options)
    : unit_(std::move(unit)),
      done_at_start_(done),
      total_(total),
      options_(std::move(options)),
      terminal_(::isatty(::fileno(options_.out)) != 0),
      start_(options_.clock()),
      next_(start_) {
  require(total >= 0, "progress of {}: expected a total of 0 or more; came {}", unit_, total);
}

Progress::~Progress() {
  if (line_open_) print(options_.out, "\n");
}

std::string Progress::line(std::int64_t done, std::string_view details, double now) const {
  std::string text = fmt::format("{} {}", unit_, done);
  if (total_ > 0) {
    text += fmt::format(" / {} ({:.0f} %)", total_,
                        100.0 * static_cast<double>(done) / static_cast<double>(total_));
  }
  const double seconds = now - start_;
  if (done > done_at_start_ && seconds > 0) {
    const double rate = static_cast<double>(done - done_at_start_) / seconds;
    text += fmt::format(", {:.0f} / s", rate);
    if (total_ > 0) {
      text += done < total_ ? fmt::format(", {} left",
                                          duration_text(static_cast<double>(total_ - done) / rate))
                            : fmt::format(", took {}", duration_text(seconds));
    }
  }
  if (!details.empty()) text.append(", ").append(details);
  return text;
}

void Progress::update(std::int64_t done, std::string_view details) {
  const double now = options_.clock();
  const bool endless = total_ == 0;
  if (now < next_ && (endless || done < total_)) return;
  next_ = now + (terminal_ ? options_.terminal_interval_s : options_.plain_interval_s);
  std::string text = line(done, details, now);
  const bool idle = endless && done == done_at_start_;
  if (endless) {
    start_ = now;
    done_at_start_ = done;
  }
  if (idle && !terminal_) return;
  if (terminal_) {
    text.resize(std::min(text.size(), width(options_.out) - 1));
    print(options_.out, fmt::format("\r{}\033[K", text));
  } else {
    print(options_.out, text + '\n');
  }
  line_open_ = terminal_;
}

}  // namespace wordgaze::io
