#include <gtest/gtest.h>

#include "support.hpp"
#include "wordgaze/nn/linear.hpp"
#include "wordgaze/optim/adam.hpp"
#include "wordgaze/optim/clip.hpp"
#include "wordgaze/optim/schedule.hpp"

namespace wordgaze::optim {
namespace {

using Params = nn::Linear<double>::Params;

Params random_params() {
  Params p;
  nn::Linear<double>::resize(p, 2, 3);
  test::randomize_parameters(p);
  return p;
}

TEST(Adam, FollowsThePublishedRecurrence) {
  Params params = random_params();
  Adam<Params> adam(params);
  double w = params.weight(1, 1), m = 0, v = 0;
  for (int t = 1; t <= 5; ++t) {
    const Params grads = random_params();
    const double g = grads.weight(1, 1);
    m = 0.9 * m + 0.1 * g;
    v = 0.999 * v + 0.001 * g * g;
    w -= 0.01 * (m / (1 - std::pow(0.9, t))) / (std::sqrt(v / (1 - std::pow(0.999, t))) + 1e-5);
    adam.step(params, grads, [](const nn::Path&) { return 0.01; });
    EXPECT_NEAR(params.weight(1, 1), w, 1e-12);
  }
}

TEST(Adam, EachLeafHasItsOwnRate) {
  Params params = random_params();
  const Params before = params;
  Adam<Params> adam(params);
  adam.step(params, random_params(),
            [](const nn::Path& path) { return path.names[0] == "bias" ? 0.1 : 0.0; });
  EXPECT_EQ(params.weight, before.weight);
  EXPECT_NE(params.bias, before.bias);
}

TEST(ClipNorm, ScalesTheWholeGradientDownAndReturnsTheNormBefore) {
  Params grads = random_params();
  const Params before = grads;
  const double norm = std::sqrt(nn::squared_norm(grads));
  EXPECT_NEAR(clip_norm(grads, norm / 2), norm, 1e-12);
  EXPECT_TRUE(grads.weight.isApprox(before.weight / 2));
  EXPECT_TRUE(grads.bias.isApprox(before.bias / 2));
  EXPECT_NEAR(clip_norm(grads, norm), norm / 2, 1e-12);
  EXPECT_TRUE(grads.bias.isApprox(before.bias / 2)) << "a small gradient is left alone";
}

TEST(ClipNorm, ReportsAGradientThatIsNotFinite) {
  Params grads = random_params();
  grads.bias(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(std::isfinite(clip_norm(grads, 1)));
}

TEST(Schedule, FallsLinearlyThenStays) {
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 0, 100), 1);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 50, 100), 0.6);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 500, 100), 0.2);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 0, 0), 0.2);
}

}  // namespace
}  // namespace wordgaze::optim
