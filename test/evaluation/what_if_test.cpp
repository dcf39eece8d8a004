#include <gtest/gtest.h>

#include "evaluation/one_decision.hpp"

namespace wordgaze::evaluation {
namespace {

/// Questions about a decision: what would the policy have been, and what does it depend on?
struct WhatIfVariant : testing::TestWithParam<bool> {};

TEST_P(WhatIfVariant, RepeatsTheDecisionWhenNothingIsChanged) {
  test::OneDecision at(GetParam());
  const auto decision = at.decide(3);  // with a memory of three steps
  policy::Policy& policy = decision.policy;
  const model::CellMatrix view = policy.frames().cells.col(0).replicate(1, 2);
  const auto policies = policy.policies_for(0, view);
  const auto logits = policy.logits(0);
  const Vector<float> expected =
      Eigen::Map<const Vector<float>>(logits.data(), grid::kActions).array().exp();
  EXPECT_TRUE(policies.col(0).isApprox(expected / expected.sum(), 1e-5f));
  EXPECT_TRUE(policies.col(0).isApprox(policies.col(1)));
  const model::CellMatrix other = model::CellMatrix::Zero(grid::kViewCells, 1);
  EXPECT_FALSE(policy.policies_for(0, other).col(0).isApprox(policies.col(0), 1e-3f));
}
INSTANTIATE_TEST_SUITE_P(Attention, WhatIfVariant, testing::Bool(),
                         [](const auto& i) { return i.param ? "With" : "Without"; });

TEST(Saliency, IsZeroWhereTheMemoryIsBlind) {
  test::OneDecision at(false);
  at.see_only(test::kCellInFront);
  const auto saliency = at.decide().policy.saliency(0, 0);
  EXPECT_GT(saliency.gradient(test::kCellInFront), 0);
  EXPECT_GT(saliency.product(test::kCellInFront), 0);
  EXPECT_EQ(saliency.gradient.sum(), saliency.gradient(test::kCellInFront));
  EXPECT_EQ(saliency.product.sum(), saliency.product(test::kCellInFront));
}

TEST(Saliency, IsToFirstOrderWhatACellAddsToTheLogit) {
  test::OneDecision at(false);
  at.see_only(test::kCellInFront);
  at.params.memory.input_weight *= 1e-3f;  // so faint that the first order is all
  at.decide();
  const float with = at.policy.logits(0)[0];
  const float product = at.policy.saliency(0, 0).product(test::kCellInFront);

  test::OneDecision without(false);
  without.params.memory.input_weight.setZero();
  without.decide();
  const float difference = std::abs(with - without.policy.logits(0)[0]);
  EXPECT_GT(difference, 1e-5f);
  EXPECT_NEAR(product / difference, 1, 0.05);
}

}  // namespace
}  // namespace wordgaze::evaluation
