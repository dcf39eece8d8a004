#pragma once
#include <algorithm>
#include <chrono>
#include <thread>

#include "wordgaze/io/stop_signals.hpp"

namespace wordgaze::apps {

/// Lets steps pass at so many a second, for somebody who watches.
class Pace {
 public:
  explicit Pace(double hz)
      : period_(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / hz))) {}

  /// Waits until the next step is due. Throws io::Stopped when a signal comes first.
  void wait() {
    constexpr Clock::duration kPatience = std::chrono::milliseconds(50);
    for (;;) {
      io::StopSignals::check();
      const auto now = Clock::now();
      if (now >= next_) {
        next_ = std::max(next_ + period_, now);  // what was late is not made up for
        return;
      }
      std::this_thread::sleep_for(std::min(next_ - now, kPatience));
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::duration period_;
  Clock::time_point next_ = Clock::now();
};

}  // namespace wordgaze::apps
