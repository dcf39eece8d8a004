#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze {

/// A fixed team of workers for short fork-join jobs. Worker 0 is the calling thread, so a team of
/// one starts no thread. Starting a job allocates nothing.
class Team {
 public:
  /// Throws std::invalid_argument for less than one worker, std::runtime_error where the system
  /// does not give that many threads.
  explicit Team(int size) : errors_(checked(size)) {
    threads_.reserve(errors_.size());
    try {
      for (int worker = 1; worker < size; ++worker) {
        threads_.emplace_back([this, worker] { serve(worker); });
      }
    } catch (const std::system_error& error) {
      dismiss();
      throw std::runtime_error(
          formatted("a team of {} threads: only {} could be started ({}); ask for fewer threads",
                    size, threads_.size() + 1, error.what()));
    } catch (...) {
      dismiss();
      throw;
    }
  }
  ~Team() { dismiss(); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return static_cast<int>(errors_.size()); }

  /// Calls job(worker) once for every worker, at the same time, and returns when all are done.
  /// Rethrows the exception of the first worker that threw, and drops those of the others.
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
    std::exception_ptr first;
    for (auto& error : errors_) {
      if (auto thrown = std::exchange(error, nullptr); !first) first = std::move(thrown);
    }
    if (first) std::rethrow_exception(std::move(first));
  }

  /// The part [first, second) of n items that worker k of `size` takes; sizes differ by at most
  /// one.
  static constexpr std::pair<int, int> share(int n, int k, int size) {
    return {static_cast<int>(std::int64_t{n} * k / size),
            static_cast<int>(std::int64_t{n} * (k + 1) / size)};
  }
  std::pair<int, int> share(int n, int k) const { return share(n, k, size()); }

 private:
  static std::size_t checked(int size) {
    require(size > 0, "a team of {} threads; expected at least 1", size);
    return static_cast<std::size_t>(size);
  }
  void dismiss() {
    stop_ = true;
    start();
    for (auto& thread : threads_) thread.join();
  }
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
