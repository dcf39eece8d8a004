#include "wordgaze/nn/gru.hpp"

#include <gtest/gtest.h>

#include "support.hpp"
#include "wordgaze/nn/gradient_check.hpp"

namespace wordgaze::nn {
namespace {

using test::random_matrix;
using G = Gru<double>;

struct GruTest : testing::Test {
  static constexpr Index kIn = 3, kHidden = 4;
  SequenceShape shape{5, 3};
  G::Params params;
  G::Cache cache;
  Matrix<double> x = random_matrix(kIn, shape.columns());
  Matrix<double> active = Matrix<double>::Zero(1, shape.columns());
  Matrix<double> dh = random_matrix(kHidden, shape.batch);
  std::array<Index, 3> length{5, 1, 3};

  void SetUp() override {
    G::resize(kIn, kHidden, params);
    test::randomize_parameters(params);
    for (Index b = 0; b < shape.batch; ++b) {
      for (Index t = 0; t < length[static_cast<std::size_t>(b)]; ++t) {
        active(0, shape.column(t, b)) = 1;
      }
    }
  }
  Matrix<double> last() {
    Matrix<double> h(kHidden, shape.batch);
    G::forward(params, shape, params.input_weight * x, active, cache, h);
    return h;
  }
  double loss() { return last().cwiseProduct(dh).sum(); }
};

TEST_F(GruTest, GradientsMatchCentralDifferences) {
  loss();
  G::Params grads = zeros_like(params);
  Matrix<double> dproduct(3 * kHidden, shape.columns());
  G::backward(params, shape, active, dh, cache, grads, dproduct);
  grads.input_weight.noalias() += dproduct * x.transpose();
  const Matrix<double> dx = params.input_weight.transpose() * dproduct;
  GradientError error = check_gradients(params, grads, [&] { return loss(); });
  check_leaf(
      "x", x, dx, [&] { return loss(); }, error);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST_F(GruTest, PaddingDoesNotChangeTheLastState) {
  const Matrix<double> before = last();
  x.col(shape.column(4, 1)).setConstant(100);
  x.col(shape.column(3, 2)).setConstant(-50);
  EXPECT_EQ(before, last());
}

TEST_F(GruTest, OneStepIsTheTextbookCell) {
  last();
  const auto sigmoid = [](double v) { return 1 / (1 + std::exp(-v)); };
  const Index t = 1, b = 0, column = shape.column(t, b);
  const Vector<double> h = cache.h_prev.col(column),
                       next = cache.h_prev.col(shape.column(t + 1, b));
  const Vector<double> z = params.input_weight * x.col(column) + params.bias;
  const Vector<double> u = params.hidden_weight * h;
  for (Index j = 0; j < kHidden; ++j) {
    const double r = sigmoid(z(j) + u(j)), update = sigmoid(z(kHidden + j) + u(kHidden + j));
    const double n =
        std::tanh(z(2 * kHidden + j) + r * (u(2 * kHidden + j) + params.candidate_bias(j)));
    EXPECT_NEAR(next(j), (1 - update) * n + update * h(j), 1e-14);
  }
}

}  // namespace
}  // namespace wordgaze::nn
