#include "wordgaze/io/stop_signals.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace wordgaze::io {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> first = 0;
std::atomic<const char*> answer_text = nullptr;
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);  // for use in a handler

/// Calls nothing but what a handler may.
void note(int signal) {
  int none = 0;
  if (!first.compare_exchange_strong(none, signal)) return;
  const int error = errno;
  for (const int deadly : {SIGINT, SIGTERM}) std::signal(deadly, SIG_DFL);
  const char* text = answer_text;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
  errno = error;
}

}  // namespace

StopSignals::StopSignals(const char* answer) {
  answer_text = answer;
  first = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (kSignals[i] == SIGHUP && before_[i].sa_handler == SIG_IGN) continue;
    ::sigaction(kSignals[i], &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int StopSignals::received() { return first; }

}  // namespace wordgaze::io
