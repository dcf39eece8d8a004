#include "wordgaze/training/ppo_loss.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support.hpp"
#include "wordgaze/nn/gradient_check.hpp"
#include "wordgaze/training/mask_loss.hpp"

namespace wordgaze::training {
namespace {

struct Case {
  const char* name;
  double old_log_prob, advantage;
};

/// Inside the clip, and beyond it on either side with either sign.
const Case kCases[] = {{"Inside", -1.6, 0.7},
                       {"AboveAndBetter", -4.0, 0.7},
                       {"AboveAndWorse", -4.0, -0.7},
                       {"BelowAndBetter", -0.1, 0.7},
                       {"BelowAndWorse", -0.1, -0.7}};

struct PpoLossCase : testing::TestWithParam<Case> {
  void expect_gradients(std::size_t actions) const;
};

/// With so many of the seven actions possible.
void PpoLossCase::expect_gradients(std::size_t actions) const {
  const PpoLoss<double> loss{.clip = 0.2, .value_coefficient = 0.5, .entropy_coefficient = 0.03};
  const PpoLoss<double>::Frame frame{2, GetParam().old_log_prob, GetParam().advantage, 0.4};
  Matrix<double> logits(7, 1), value(1, 1);
  logits << 0.3, -0.2, 0.5, 0.1, -0.7, 0.0, 0.2;
  value << 1.3;
  std::vector<double> dlogits(7), unused(7);
  double dvalue = 0;
  const double scale = 0.25;
  PpoLoss<double>::Sums sums;
  const auto z = std::span<const double>(logits.data(), actions);
  loss.add(frame, z, value(0), scale, std::span(dlogits).first(actions), dvalue, sums);

  const auto total = [&] {
    PpoLoss<double>::Sums s;
    double d = 0;
    loss.add(frame, z, value(0), scale, std::span(unused).first(actions), d, s);
    return scale * (s.policy + 0.5 * s.value - 0.03 * s.entropy);
  };
  nn::GradientError error;
  nn::check_leaf("logits", logits, dlogits, total, error);
  nn::check_leaf("value", value, std::vector<double>{dvalue}, total, error);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST_P(PpoLossCase, GradientsMatchCentralDifferences) { expect_gradients(7); }

TEST_P(PpoLossCase, WhatIsNotPossibleHasNoPart) { expect_gradients(3); }

INSTANTIATE_TEST_SUITE_P(Ratio, PpoLossCase, testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(PpoLoss, AClippedGainPullsNoFurther) {
  const PpoLoss<double> loss{.clip = 0.2, .value_coefficient = 0, .entropy_coefficient = 0};
  const std::vector<double> logits(7, 0.0);
  std::vector<double> dlogits(7);
  double dvalue = 0;
  PpoLoss<double>::Sums sums;
  // log(1/7) is far above the old log-probability: the ratio is clipped.
  loss.add({2, -5.0, 1.0, 0}, logits, 0, 1, dlogits, dvalue, sums);
  EXPECT_EQ(dlogits, std::vector<double>(7, 0.0));
  EXPECT_EQ(sums.clipped, 1);
  EXPECT_DOUBLE_EQ(sums.policy, -1.2);
}

TEST(MaskLoss, IsNothingWithoutWords) {
  Vector<double> dlogits = Vector<double>::Zero(8);
  EXPECT_EQ(mask_loss({}, 1, Vector<double>::Constant(8, 0.5), 1, dlogits), 0);
  EXPECT_EQ(dlogits, Vector<double>::Zero(8));
}

TEST(MaskLoss, GradientMatchesCentralDifferences) {
  babyai::Sentence sentence;
  for (int i = 0; i < 3; ++i) sentence.append(3, 0);
  sentence.append(4, -1);
  for (int i = 0; i < 2; ++i) sentence.append(5, 1);
  Matrix<double> logits = test::random_matrix(8, 1);
  Vector<double> alpha = logits.array().logistic();
  Vector<double> dlogits = Vector<double>::Zero(8), unused = dlogits;
  const std::uint8_t bright = 0b10;  // the second clause only
  mask_loss(sentence, bright, alpha, 1.5, dlogits);
  nn::GradientError error;
  nn::check_leaf(
      "logits", logits, dlogits,
      [&] {
        const Vector<double> a = logits.array().logistic();
        return 1.5 * mask_loss(sentence, bright, a, 1, unused);
      },
      error);
  EXPECT_LE(error.worst, 1e-6) << error.where;
  EXPECT_EQ(dlogits.tail(2).cwiseAbs().sum(), 0) << "words behind the end have no truth";
}

}  // namespace
}  // namespace wordgaze::training
