#include "wordgaze/nn/categorical.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support.hpp"
#include "wordgaze/nn/gradient_check.hpp"

namespace wordgaze::nn {
namespace {

using C = Categorical<double>;

struct CategoricalTest : testing::Test {
  Matrix<double> logits = test::random_matrix(7, 1, 2);
  std::vector<double> log_p = std::vector<double>(7);
  std::span<const double> z{logits.data(), 7};
  void SetUp() override { C::log_softmax(z, log_p); }
};

TEST_F(CategoricalTest, ProbabilitiesSumToOne) {
  double sum = 0;
  for (const double l : log_p) sum += std::exp(l);
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST_F(CategoricalTest, SurvivesHugeLogits) {
  logits.array() += 1e4;
  std::vector<double> shifted(7);
  C::log_softmax(z, shifted);
  for (std::size_t a = 0; a < 7; ++a) EXPECT_NEAR(shifted[a], log_p[a], 1e-9);
}

TEST_F(CategoricalTest, EntropyGradientMatchesCentralDifferences) {
  std::vector<double> gradient(7);
  C::add_entropy_gradient(log_p, C::entropy(log_p), 3.0, gradient);
  GradientError error;
  check_leaf(
      "logits", logits, gradient,
      [&] {
        std::vector<double> l(7);
        C::log_softmax(z, l);
        return 3 * C::entropy(l);
      },
      error);
  EXPECT_LE(error.worst, 1e-6);
}

TEST_F(CategoricalTest, LogProbabilityGradientMatchesCentralDifferences) {
  std::vector<double> gradient(7);
  C::add_log_prob_gradient(log_p, 4, -2.0, gradient);
  GradientError error;
  check_leaf(
      "logits", logits, gradient,
      [&] {
        std::vector<double> l(7);
        C::log_softmax(z, l);
        return -2 * l[4];
      },
      error);
  EXPECT_LE(error.worst, 1e-6);
}

TEST_F(CategoricalTest, SamplesByQuantile) {
  double cumulative = 0;
  for (std::size_t a = 0; a < 7; ++a) {
    const double p = std::exp(log_p[a]);
    EXPECT_EQ(C::sample(log_p, cumulative + p / 2), a);
    cumulative += p;
  }
  EXPECT_EQ(C::sample(log_p, 0.9999999999999999), 6u);
}

TEST_F(CategoricalTest, GreedyTakesTheLargest) {
  logits(5, 0) = 100;
  EXPECT_EQ(C::greedy(z), 5u);
}

}  // namespace
}  // namespace wordgaze::nn
