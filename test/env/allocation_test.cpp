// Counts what the simulator takes from the heap: replaces operator new for the whole program.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "wordgaze/env/environment.hpp"

namespace {
std::atomic<std::int64_t> allocations = 0;
}  // namespace

// All forms, for memory of one must not go to another's. Not inlined: GCC would take the pairs for
// mismatches.
#define WORDGAZE_REPLACES [[gnu::noinline]]

namespace {

void* take(std::size_t size, std::size_t alignment = alignof(std::max_align_t)) noexcept {
  ++allocations;
  if (alignment <= alignof(std::max_align_t)) return std::malloc(std::max<std::size_t>(size, 1));
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, size) == 0 ? memory : nullptr;
}
void* take_or_throw(std::size_t size, std::size_t alignment = alignof(std::max_align_t)) {
  if (void* memory = take(size, alignment)) return memory;
  throw std::bad_alloc();
}

}  // namespace

using std::align_val_t;
using std::nothrow_t;
using std::size_t;

WORDGAZE_REPLACES void* operator new(size_t n) { return take_or_throw(n); }
WORDGAZE_REPLACES void* operator new[](size_t n) { return take_or_throw(n); }
WORDGAZE_REPLACES void* operator new(size_t n, const nothrow_t&) noexcept { return take(n); }
WORDGAZE_REPLACES void* operator new[](size_t n, const nothrow_t&) noexcept { return take(n); }
WORDGAZE_REPLACES void* operator new(size_t n, align_val_t a) {
  return take_or_throw(n, size_t(a));
}
WORDGAZE_REPLACES void* operator new[](size_t n, align_val_t a) {
  return take_or_throw(n, size_t(a));
}
WORDGAZE_REPLACES void* operator new(size_t n, align_val_t a, const nothrow_t&) noexcept {
  return take(n, size_t(a));
}
WORDGAZE_REPLACES void* operator new[](size_t n, align_val_t a, const nothrow_t&) noexcept {
  return take(n, size_t(a));
}
WORDGAZE_REPLACES void operator delete(void* p) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete[](void* p) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete(void* p, size_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete[](void* p, size_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete(void* p, const nothrow_t&) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete[](void* p, const nothrow_t&) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete(void* p, align_val_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete[](void* p, align_val_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete(void* p, size_t, align_val_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete[](void* p, size_t, align_val_t) noexcept { std::free(p); }
WORDGAZE_REPLACES void operator delete(void* p, align_val_t, const nothrow_t&) noexcept {
  std::free(p);
}
WORDGAZE_REPLACES void operator delete[](void* p, align_val_t, const nothrow_t&) noexcept {
  std::free(p);
}

namespace wordgaze::env {
namespace {

class Allocation : public testing::TestWithParam<const char*> {};

TEST_P(Allocation, NeitherStepsNorViewsNorResetsAllocateAfterWarmUp) {
  Environment env(GetParam());
  std::array<std::uint8_t, grid::kImageBytes> image;
  core::Rng rng(1);
  const auto play = [&](int resets) {
    for (int n = 0; n < resets; ++n) {
      env.reset();
      for (int k = 0; k < 20; ++k) {
        env.step(static_cast<grid::Action>(rng.below(env.num_actions())));
        env.observe(image);
      }
    }
  };
  env.reset(1);
  play(200);
  const std::int64_t before = allocations;
  play(200);
  EXPECT_EQ(allocations - before, 0);
}

INSTANTIATE_TEST_SUITE_P(, Allocation,
                         testing::Values("BabyAI-GoToLocal-v0", "Wordgaze-Two-N8-K4-v0",
                                         "Wordgaze-Eight-N8-K8-v0", "BabyAI-BossLevel-v0",
                                         "BabyAI-Open-v0", "BabyAI-MiniBossLevel-v0",
                                         "BabyAI-Unlock-v0", "MiniGrid-MultiRoom-N6-v0",
                                         "MiniGrid-LockedRoom-v0", "MiniGrid-Fetch-8x8-N3-v0",
                                         "MiniGrid-Dynamic-Obstacles-8x8-v0"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace wordgaze::env
