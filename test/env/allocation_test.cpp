// Counts what the simulator takes from the heap: replaces operator new for the whole program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "wordgaze/env/environment.hpp"

namespace {
std::atomic<std::int64_t> allocations = 0;
}  // namespace

// Not inlined: GCC would take the pair for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

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
