#include "wordgaze/core/team.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace wordgaze {
namespace {

TEST(Team, EveryWorkerRunsEveryJobOnce) {
  Team team(3);
  std::vector<int> runs(3);
  for (int job = 0; job < 1000; ++job) {
    team.run([&](int worker) { ++runs[static_cast<std::size_t>(worker)]; });
  }
  EXPECT_EQ(runs, (std::vector<int>{1000, 1000, 1000}));
}

TEST(Team, SharesCoverAllItemsInOrder) {
  for (const int n : {0, 1, 5, 49}) {
    int next = 0;
    for (int k = 0; k < 4; ++k) {
      const auto [from, to] = Team::share(n, k, 4);
      EXPECT_EQ(from, next);
      EXPECT_LE(to - from, (n + 3) / 4);
      next = to;
    }
    EXPECT_EQ(next, n);
  }
}

TEST(Team, RethrowsWhatAWorkerThrewAndGoesOn) {
  Team team(2);
  for (const int guilty : {0, 1}) {
    EXPECT_THROW(team.run([&](int w) {
      if (w == guilty) throw std::runtime_error("broken");
    }),
                 std::runtime_error);
  }
  int done = 0;
  team.run([&](int w) { done += w == 0; });
  EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace wordgaze
