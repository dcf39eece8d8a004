#include "support/golden.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wordgaze::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-6;
constexpr Index kSize = 7;  // packets of any width, and a rest

TEST(RelativeError, IsThatOfTheWorstEntry) {
  const Matrix<double> theirs{{2, -4}, {0, 1}};
  EXPECT_EQ(relative_error(theirs, theirs), 0);
  EXPECT_DOUBLE_EQ(relative_error(Matrix<double>{{2, -3}, {0, 1}}, theirs), 0.25);
}

TEST(RelativeError, IsBelowNoToleranceWhereAnEntryIsNotFinite) {
  const Matrix<double> good = Matrix<double>::Ones(kSize, kSize);
  for (const double broken : {std::nan(""), kInfinity, -kInfinity}) {
    for (Index i = 0; i < good.size(); ++i) {
      Matrix<double> bad = good;
      bad.data()[i] = broken;
      EXPECT_FALSE(relative_error(bad, good) <= kTolerance) << broken << " of ours at " << i;
      EXPECT_FALSE(relative_error(good, bad) <= kTolerance) << broken << " of theirs at " << i;
      EXPECT_FALSE(relative_error(bad, bad) <= kTolerance) << broken << " of both at " << i;
    }
  }
}

}  // namespace
}  // namespace wordgaze::test
