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
  nn::Linear<double>::resize(2, 3, p);
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

TEST(Adam, PartsMakeTheSameStepAsTheWhole) {
  Params whole = random_params(), parts = whole;
  const Params grads = random_params();
  const auto rate = [](const nn::Path&) { return 0.01; };
  Adam<Params> a(whole), b(parts);
  a.step(whole, grads, rate, 0.5);
  b.begin_step();
  for (Index k = 0; k < 4; ++k) b.update(parts, grads, rate, 0.5, {k, 4});
  EXPECT_EQ(whole.weight, parts.weight);
  EXPECT_EQ(whole.bias, parts.bias);
}

TEST(Adam, ScalesTheGradient) {
  Params plain = random_params(), scaled = plain, grads = random_params();
  const auto rate = [](const nn::Path&) { return 0.01; };
  Adam<Params> a(plain), b(scaled);
  b.step(scaled, grads, rate, 0.25);
  nn::for_each_parameter([](const nn::Path&, auto& leaf) { leaf *= 0.25; }, grads);
  a.step(plain, grads, rate);
  EXPECT_TRUE(plain.weight.isApprox(scaled.weight, 1e-15));
}

TEST(SquaredNorm, OfThePartsAddsUp) {
  const Params p = random_params();
  const double plain = p.weight.squaredNorm() + p.bias.squaredNorm();
  EXPECT_NEAR(nn::squared_norm(p), plain, 1e-12);
  double sum = 0;
  for (Index k = 0; k < 4; ++k) sum += nn::squared_norm(p, {k, 4});
  EXPECT_NEAR(sum, plain, 1e-12);
}

TEST(ClipScale, BringsANormDownToTheLimit) {
  EXPECT_DOUBLE_EQ(clip_scale(4, 0.5), 0.125);
  EXPECT_DOUBLE_EQ(clip_scale(0.5, 0.5), 1);
  EXPECT_DOUBLE_EQ(clip_scale(0, 0.5), 1) << "a small gradient is left alone";
}

TEST(Schedule, FallsLinearlyThenStays) {
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 0, 100), 1);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 50, 100), 0.6);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 500, 100), 0.2);
  EXPECT_DOUBLE_EQ(linear(1, 0.2, 0, 0), 0.2);
}

}  // namespace
}  // namespace wordgaze::optim
