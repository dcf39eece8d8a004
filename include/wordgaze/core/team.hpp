#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace wordgaze {

/// A fixed team of workers for short fork-join jobs. Worker 0 is the calling thread, so a team of
/// one starts no thread. Starting a job allocates nothing.
class Team {
 public:
  explicit Team(int size) : errors_(static_cast<std::size_t>(size)) {
    for (int worker = 1; worker < size; ++worker) {
      threads_.emplace_back([this, worker] { serve(worker); });
    }
  }
  ~Team() {
    stop_ = true;
    start();
    for (auto& thread : threads_) thread.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return static_cast<int>(errors_.size()); }

  /// Calls job(worker) once for every worker, at the same time, and returns when all are done.
  /// Rethrows the exception of the first worker that threw.
  template <class Job>
  void run(Job&& job) {
    job_ = &job;
    call_ = [](void* j, int worker) { (*static_cast<std::remove_reference_t<Job>*>(j))(worker); };
    left_.store(size() - 1, std::memory_order_relaxed);
    start();
    work(0);
    for (int left = left_.load(std::memory_order_acquire); left > 0;
         left = left_.load(std::memory_order_acquire)) {
      wait_while(left_, left);
    }
    for (auto& error : errors_) {
      if (error) std::rethrow_exception(std::exchange(error, nullptr));
    }
  }

  /// The part [first, second) of n items that worker k of `size` takes; sizes differ by at most
  /// one.
  static constexpr std::pair<int, int> share(int n, int k, int size) {
    return {static_cast<int>(std::int64_t{n} * k / size),
            static_cast<int>(std::int64_t{n} * (k + 1) / size)};
  }
  std::pair<int, int> share(int n, int k) const { return share(n, k, size()); }

 private:
  void start() {
    generation_.fetch_add(1, std::memory_order_release);
    generation_.notify_all();
  }
  /// Jobs are short: look a while before sleeping.
  template <class T>
  static void wait_while(std::atomic<T>& value, T old) {
    for (int look = 0; look < 4000; ++look) {
      if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
      __builtin_ia32_pause();
#endif
    }
    value.wait(old, std::memory_order_acquire);
  }
  void work(int worker) {
    try {
      call_(job_, worker);
    } catch (...) {
      errors_[static_cast<std::size_t>(worker)] = std::current_exception();
    }
  }
  void serve(int worker) {
    for (std::uint32_t seen = 0;; ++seen) {
      wait_while(generation_, seen);
      if (stop_) return;
      work(worker);
      if (left_.fetch_sub(1, std::memory_order_acq_rel) == 1) left_.notify_all();
    }
  }

  std::vector<std::thread> threads_;
  std::vector<std::exception_ptr> errors_;
  std::atomic<std::uint32_t> generation_ = 0;
  std::atomic<int> left_ = 0;
  std::atomic<bool> stop_ = false;
  void* job_ = nullptr;
  void (*call_)(void*, int) = nullptr;
};

}  // namespace wordgaze
