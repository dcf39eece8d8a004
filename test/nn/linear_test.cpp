#include "wordgaze/nn/linear.hpp"

#include <gtest/gtest.h>

#include "support.hpp"
#include "wordgaze/nn/gradient_check.hpp"

namespace wordgaze::nn {
namespace {

TEST(Linear, GradientsMatchCentralDifferences) {
  using L = Linear<double>;
  L::Params params;
  L::resize(3, 2, params);
  test::randomize_parameters(params);
  Matrix<double> x = test::random_matrix(3, 5), dx(3, 5), y(2, 5);
  const Matrix<double> dy = test::random_matrix(2, 5);
  const auto loss = [&] {
    L::forward(params, x, {}, y);
    return y.cwiseProduct(dy).sum();
  };
  loss();
  L::Params grads = zeros_like(params);
  L::backward(params, x, dy, {}, grads, dx);
  GradientError error = check_gradients(params, grads, loss);
  check_leaf("x", x, dx, loss, error);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST(GradientCheck, FindsAWrongGradient) {
  using L = Linear<double>;
  L::Params params;
  L::resize(2, 2, params);
  test::randomize_parameters(params);
  const Matrix<double> x = test::random_matrix(2, 3);
  Matrix<double> y(2, 3), dx(2, 3);
  const auto loss = [&] {
    L::forward(params, x, {}, y);
    return y.sum();
  };
  loss();
  L::Params grads = zeros_like(params);
  L::backward(params, x, Matrix<double>::Ones(2, 3), {}, grads, dx);
  grads.weight(1, 0) += 1e-3;
  const GradientError error = check_gradients(params, grads, loss);
  EXPECT_GT(error.worst, 1e-5);
  EXPECT_EQ(error.where, "weight[1]");
}

}  // namespace
}  // namespace wordgaze::nn
