#include "wordgaze/core/team.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

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
  std::vector<int> runs(2);
  team.run([&](int w) { ++runs[static_cast<std::size_t>(w)]; });
  EXPECT_EQ(runs, (std::vector<int>{1, 1}));
}

TEST(Team, RethrowsTheFirstOfSeveralExceptionsAndForgetsTheOthers) {
  Team team(3);
  try {
    team.run([](int w) {
      if (w > 0) throw std::runtime_error(std::to_string(w));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "1");
  }
  EXPECT_NO_THROW(team.run([](int) {}));
}

TEST(Team, RefusesToBeNobody) {
  EXPECT_THROW(Team(0), std::invalid_argument);
  EXPECT_THROW(Team(-1), std::invalid_argument);
}

TEST(Team, ThatCannotHaveItsThreadsSaysSo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers want more room than this leaves";
#endif
  // Room for a few stacks of threads, no more.
  EXPECT_EXIT(
      {
        rlimit limit{};
        ::getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = 400'000 * rlim_t{1024};
        ::setrlimit(RLIMIT_AS, &limit);
        try {
          const Team team(256);
        } catch (const std::runtime_error& error) {
          std::fprintf(stderr, "%s\n", error.what());
          std::exit(3);
        }
        std::exit(0);
      },
      testing::ExitedWithCode(3), "256 threads");
}

}  // namespace
}  // namespace wordgaze
