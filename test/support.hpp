#pragma once
#include <random>

#include "wordgaze/nn/parameters.hpp"

/// Random values for the tests of layers.
namespace wordgaze::test {

inline std::mt19937& generator() {
  static std::mt19937 engine(20260101);
  return engine;
}

template <class M>
void randomize(M& matrix, double scale = 1) {
  std::normal_distribution<double> normal(0, scale);
  for (Index i = 0; i < matrix.size(); ++i) {
    matrix.data()[i] = static_cast<typename M::Scalar>(normal(generator()));
  }
}

template <nn::Tree P>
void randomize_parameters(P& params, double scale = 0.5) {
  nn::for_each_parameter([&](const nn::Path&, auto& leaf) { randomize(leaf, scale); }, params);
}

inline Matrix<double> random_matrix(Index rows, Index cols, double scale = 1) {
  Matrix<double> m(rows, cols);
  randomize(m, scale);
  return m;
}

}  // namespace wordgaze::test
