#include "wordgaze/nn/gradient_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace wordgaze::nn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Index kEntries = 3;

/// Checks the gradient of x'x / 2, which is x, with one entry replaced; the loss is multiplied by
/// `broken_loss` while that entry is off its place.
GradientError check(Index broken, double broken_gradient, double broken_loss) {
  const Vector<double> at{{0.5, -1, 2}};
  Vector<double> x = at, gradient = at;
  gradient(broken) = broken_gradient;
  const auto loss = [&] {
    return x.squaredNorm() / 2 * (x(broken) == at(broken) ? 1 : broken_loss);
  };
  GradientError error;
  check_leaf("x", x, gradient, loss, error);
  return error;
}

std::string entry(Index i) { return "x[" + std::to_string(i) + "]"; }

TEST(GradientCheck, NeverForgetsAGradientThatIsNotFinite) {
  for (const double broken : {std::nan(""), kInfinity, -kInfinity}) {
    for (Index i = 0; i < kEntries; ++i) {
      const GradientError error = check(i, broken, 1);
      EXPECT_FALSE(error.worst <= 1e-6) << broken << " became " << error.worst;
      EXPECT_EQ(error.where, entry(i)) << broken;
    }
  }
}

TEST(GradientCheck, NeverForgetsALossThatIsNotFinite) {
  for (const double broken : {std::nan(""), kInfinity, -kInfinity}) {
    for (Index i = 0; i < kEntries; ++i) {
      const GradientError error = check(i, 1, broken);
      EXPECT_FALSE(error.worst <= 1e-6) << broken << " became " << error.worst;
      EXPECT_EQ(error.where, entry(i)) << broken;
    }
  }
}

TEST(GradientCheck, KeepsANaNFromLeafToLeaf) {
  GradientError error{.worst = std::nan(""), .where = "first[1]"};
  Vector<double> x{{1, 2}};
  check_leaf(
      "second", x, Vector<double>{{7, 7}}, [&] { return x.sum(); }, error);
  EXPECT_TRUE(std::isnan(error.worst));
  EXPECT_EQ(error.where, "first[1]");
}

}  // namespace
}  // namespace wordgaze::nn
