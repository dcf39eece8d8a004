#pragma once
#include <csignal>
#include <stdexcept>

namespace wordgaze::io {

/// The work was ended by a signal.
class Stopped : public std::runtime_error {
 public:
  explicit Stopped(int signal) : std::runtime_error("stopped by a signal"), signal_(signal) {}
  int signal() const { return signal_; }
  /// As a shell has it.
  int exit_code() const { return 128 + signal_; }

 private:
  int signal_;
};

/// While it lives, SIGINT, SIGTERM and SIGHUP are a wish to stop that the work asks for: the first
/// is answered with a line on standard error at once. Another SIGINT or SIGTERM then ends the
/// program as usual; another SIGHUP does not, for a terminal that closes may send several. A SIGHUP
/// that was ignored (nohup) stays so. One at a time in a program.
class StopSignals {
 public:
  /// `answer` must outlive the object.
  explicit StopSignals(const char* answer);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// The first signal that came; 0: none. Any thread may ask.
  static int received();
  /// Throws Stopped if one came.
  static void check() {
    if (const int signal = received(); signal != 0) throw Stopped(signal);
  }

 private:
  struct sigaction before_[3];
};

}  // namespace wordgaze::io
