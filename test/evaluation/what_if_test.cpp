#include "wordgaze/evaluation/what_if.hpp"

#include <gtest/gtest.h>

#include "evaluation/one_decision.hpp"

namespace wordgaze::evaluation {
namespace {

struct WhatIfVariant : testing::TestWithParam<bool> {};

TEST_P(WhatIfVariant, RepeatsTheDecisionWhenNothingIsChanged) {
  test::OneDecision at(GetParam());
  const auto decision = at.decide(3);  // with a memory of three steps
  WhatIf what_if(at.agent, at.params);
  const model::CellMatrix view = at.actor.frames().cells.col(0).replicate(1, 2);
  const auto policies = what_if.policies(decision, view);
  const Vector<float> expected = at.actor.cache().logits().col(0).array().exp();
  EXPECT_TRUE(policies.col(0).isApprox(expected / expected.sum(), 1e-5f));
  EXPECT_TRUE(policies.col(0).isApprox(policies.col(1)));
  const model::CellMatrix other = model::CellMatrix::Zero(grid::kViewCells, 1);
  EXPECT_FALSE(what_if.policies(decision, other).col(0).isApprox(policies.col(0), 1e-3f));
}
INSTANTIATE_TEST_SUITE_P(Attention, WhatIfVariant, testing::Bool(),
                         [](const auto& i) { return i.param ? "With" : "Without"; });

TEST(Saliency, IsZeroWhereTheMemoryIsBlind) {
  test::OneDecision at(false);
  at.see_only(test::kCellInFront);
  WhatIf what_if(at.agent, at.params);
  const auto saliency = what_if.saliency(at.decide());
  EXPECT_GT(saliency.gradient(test::kCellInFront), 0);
  EXPECT_GT(saliency.product(test::kCellInFront), 0);
  EXPECT_EQ(saliency.gradient.sum(), saliency.gradient(test::kCellInFront));
  EXPECT_EQ(saliency.product.sum(), saliency.product(test::kCellInFront));
}

TEST(Saliency, IsToFirstOrderWhatACellAddsToTheLogit) {
  test::OneDecision at(false);
  at.see_only(test::kCellInFront);
  at.params.memory.input_weight *= 1e-3f;  // so faint that the first order is all
  const auto decision = at.decide();
  const float with = at.actor.cache().logits()(0, 0);
  WhatIf what_if(at.agent, at.params);
  const float product = what_if.saliency(decision).product(test::kCellInFront);

  test::OneDecision without(false);
  without.params.memory.input_weight.setZero();
  without.decide();
  const float difference = std::abs(with - without.actor.cache().logits()(0, 0));
  EXPECT_GT(difference, 1e-5f);
  EXPECT_NEAR(product / difference, 1, 0.05);
}

}  // namespace
}  // namespace wordgaze::evaluation
