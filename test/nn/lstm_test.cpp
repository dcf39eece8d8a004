#include "wordgaze/nn/lstm.hpp"

#include <gtest/gtest.h>

#include "support.hpp"
#include "wordgaze/nn/gradient_check.hpp"

namespace wordgaze::nn {
namespace {

using test::random_matrix;
using L = Lstm<double>;

struct LstmTest : testing::Test {
  static constexpr Index kIn = 3, kHidden = 4;
  SequenceShape shape{5, 2};
  L::Params params;
  L::State start;
  L::Cache cache;
  Matrix<double> x = random_matrix(kIn, shape.columns());
  Matrix<double> keep = Matrix<double>::Ones(1, shape.columns());
  Matrix<double> dh = random_matrix(kHidden, shape.columns());
  Matrix<double> h = Matrix<double>(kHidden, shape.columns());
  Matrix<double> dproduct = Matrix<double>(4 * kHidden, shape.columns());

  void SetUp() override {
    L::resize(kIn, kHidden, params);
    test::randomize_parameters(params);
    start = {random_matrix(kHidden, shape.batch), random_matrix(kHidden, shape.batch)};
    cache.resize(kHidden, shape);
    keep(0, shape.column(2, 1)) = 0;
    keep(0, shape.column(3, 0)) = 0;
  }
  void forward() { L::forward(params, shape, params.input_weight * x, keep, start, cache, h); }
  double loss() {
    forward();
    return h.cwiseProduct(dh).sum();
  }
};

TEST_F(LstmTest, GradientsMatchCentralDifferences) {
  loss();
  L::Params grads = zeros_like(params);
  L::backward(params, shape, keep, dh, cache, grads, dproduct);
  grads.input_weight.noalias() += dproduct * x.transpose();
  const Matrix<double> dx = params.input_weight.transpose() * dproduct;
  GradientError error = check_gradients(params, grads, [&] { return loss(); });
  check_leaf(
      "x", x, dx, [&] { return loss(); }, error);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST_F(LstmTest, ForgetsAtEpisodeStart) {
  forward();
  const Index column = shape.column(3, 0);
  const Matrix<double> before = h.col(column), c = cache.cell.col(column);
  start.h.setConstant(7);
  x.leftCols(column).setConstant(-3);
  forward();
  EXPECT_EQ(before, h.col(column));
  EXPECT_EQ(c, cache.cell.col(column));
}

TEST_F(LstmTest, OneStepIsTheTextbookCell) {
  forward();
  const auto sigmoid = [](double v) { return 1 / (1 + std::exp(-v)); };
  const Vector<double> z =
      params.input_weight * x.col(0) + params.hidden_weight * start.h.col(0) + params.bias;
  for (Index j = 0; j < kHidden; ++j) {
    const double i = sigmoid(z(j)), f = sigmoid(z(kHidden + j));
    const double g = std::tanh(z(2 * kHidden + j)), o = sigmoid(z(3 * kHidden + j));
    const double c = f * start.c(j, 0) + i * g;
    EXPECT_NEAR(cache.cell(j, 0), c, 1e-14);
    EXPECT_NEAR(h(j, 0), o * std::tanh(c), 1e-14);
  }
}

TEST_F(LstmTest, ChunksFromStoredStateEqualTheWholeSequence) {
  forward();
  const Matrix<double> whole = h;
  const SequenceShape half{2, shape.batch};
  L::Cache part;
  part.resize(kHidden, half);
  L::State state = start;
  for (Index t = 0; t < 4; t += 2) {
    const auto columns = [&](const auto& m) {
      return m.middleCols(t * shape.batch, half.columns());
    };
    Matrix<double> part_h(kHidden, half.columns());
    L::forward(params, half, params.input_weight * columns(x), columns(keep), state, part, part_h);
    EXPECT_TRUE(part_h.isApprox(whole.middleCols(t * shape.batch, half.columns()), 1e-14));
    state.h = half.block(part_h, 1);
    state.c = half.block(part.cell, 1);
  }
}

}  // namespace
}  // namespace wordgaze::nn
