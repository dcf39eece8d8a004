#include "wordgaze/model/convolution.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace wordgaze::model {
namespace {

using test::random_matrix;

/// A map of two frames with random cells and zeros between them.
Matrix<double> random_map(Index channels) {
  Matrix<double> map = Matrix<double>::Zero(channels, map_columns(2));
  for (Index n = 0; n < 2; ++n) {
    for (Index cell = 0; cell < grid::kViewCells; ++cell) {
      map.col(kMapMargin + n * kMapSlots + map_slot(cell)) = random_matrix(channels, 1);
    }
  }
  return map;
}

TEST(Convolution, SeesTheNineCellsAroundAndZerosOutside) {
  const Matrix<double> x = random_map(1);
  Matrix<double> y = Matrix<double>::Zero(1, x.cols());
  Convolution<double>::Params p{Matrix<double>(1, kTaps), Vector<double>::Constant(1, 0.5)};
  p.weight << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  Convolution<double>::forward(p, x, y);
  for (Index n = 0; n < 2; ++n) {
    const auto in = [&](Index a, Index b) {
      const bool inside = a >= 0 && a < 7 && b >= 0 && b < 7;
      return inside ? map_frame(x, n)(0, map_slot(a * 7 + b)) : 0.0;
    };
    for (Index a = 0; a < 7; ++a) {
      for (Index b = 0; b < 7; ++b) {
        double sum = p.bias(0);
        for (Index tap = 0; tap < 9; ++tap) {
          sum += p.weight(tap) * in(a + tap / 3 - 1, b + tap % 3 - 1);
        }
        EXPECT_NEAR(map_frame(y, n)(0, map_slot(a * 7 + b)), sum, 1e-14) << a << "," << b;
      }
    }
  }
}

TEST(Convolution, BackwardIsItsAdjoint) {
  using C = Convolution<double>;
  const Matrix<double> x = random_map(3), dy = random_map(3);
  C::Params p{random_matrix(3, 27), Vector<double>::Zero(3)};
  Matrix<double> y = x, dx = x, turned(3, 27);
  C::forward(p, x, y);
  C::turn(p.weight, turned);
  C::Params grads = nn::zeros_like(p);
  C::backward(turned, x, dy, grads, dx);
  // What lies between the cells of y and dx meets the zeros of dy and x.
  const double product = map_body(y).cwiseProduct(map_body(dy)).sum();
  EXPECT_NEAR(product, map_body(dx).cwiseProduct(map_body(x)).sum(), 1e-12);
  EXPECT_NEAR(product, grads.weight.cwiseProduct(p.weight).sum(), 1e-12);
  EXPECT_TRUE(grads.bias.isApprox(map_body(dy).rowwise().sum()));
}

}  // namespace
}  // namespace wordgaze::model
