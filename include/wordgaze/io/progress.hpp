#pragma once
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace wordgaze::io {

/// "1:02:03", "2:03"
std::string duration_text(double seconds);

/// How far a long job is: "frames 1200000 / 2000000 (60 %), 9870 / s, 1:21 left, " and the caller's
/// details. A job without an end, of total 0, says "requests 1200, 20 / s, ". On a terminal one
/// line that is rewritten; else (a file, a pipe) a line now and then. It is decoration: where it
/// cannot be written (a full disk, a terminal or pipe that is closed), nothing happens.
class Progress {
 public:
  using Clock = std::function<double()>;  ///< seconds from any beginning

  struct Options {
    std::FILE* out = stderr;
    double terminal_interval_s = 0.2;
    double plain_interval_s = 10;
    Clock clock = [] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
          .count();
    };
  };

  /// `done` of `total` units are already done (a run that goes on); total 0: there is no end.
  Progress(std::string unit, std::int64_t done, std::int64_t total)
      : Progress(std::move(unit), done, total, Options{}) {}
  Progress(std::string unit, std::int64_t done, std::int64_t total, Options options);
  /// Ends the line on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the line if it is time to; the last unit is always shown. A job without an end measures
  /// its rate from one line to the next, and in a file says nothing while nothing is done.
  void update(std::int64_t done, std::string_view details);

 private:
  std::string line(std::int64_t done, std::string_view details, double now) const;

  std::string unit_;
  std::int64_t done_at_start_, total_;
  Options options_;
  bool terminal_;
  double start_, next_;
  bool line_open_ = false;
};

}  // namespace wordgaze::io
