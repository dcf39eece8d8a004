#include "wordgaze/evaluation/transparency.hpp"

#include <gtest/gtest.h>

#include "evaluation/one_decision.hpp"
#include "wordgaze/evaluation/evaluator.hpp"

namespace wordgaze::evaluation {
namespace {

/// A short evaluation of an agent without training.
struct Measured {
  test::OneDecision at;
  Transparency transparency;
  EvaluationResult result;

  explicit Measured(bool attention)
      : at(attention), transparency(at.agent.config, model::MaskTruth::current) {
    Team team(2);
    result = evaluate(policy_factory(at.agent, at.weights), evaluation(), team,
                      {.decisions = &transparency});
  }
  static Evaluation evaluation() {
    return {.level = babyai::find_level("Wordgaze-Two-N6-K3-v0"), .episodes = 20, .lanes = 3};
  }
};

TEST(Transparency, SeesEveryDecisionAndChangesNone) {
  const Measured measured(true);
  EXPECT_EQ(measured.transparency.decisions(), measured.result.steps);
  Team team(2);
  const auto alone = evaluate(policy_factory(measured.at.agent, measured.at.weights),
                              Measured::evaluation(), team);
  EXPECT_EQ(alone.successes, measured.result.successes);
  EXPECT_EQ(alone.steps, measured.result.steps);
}

TEST(Transparency, AgreesWithThePointingOfTheEvaluation) {
  const Measured measured(true);
  const auto& pointing = measured.transparency.gaze().pointing;
  EXPECT_EQ(pointing.target.count, measured.result.pointing.target.count);
  EXPECT_DOUBLE_EQ(pointing.target.value(), measured.result.pointing.target.value());
}

TEST(Transparency, OfTheBaselineIsItsSaliency) {
  const Measured measured(false);
  const auto& t = measured.transparency;
  EXPECT_FALSE(t.has_gaze());
  EXPECT_EQ(t.gaze().pointing.target.count, 0);
  EXPECT_EQ(t.weights().content.count, 0);
  EXPECT_EQ(t.mask().bright.count, 0);
  EXPECT_GT(t.gradient().pointing.target.count, 0);
  EXPECT_GT(t.gradient_times_input().faithfulness.shift[0].count, 0);
}

}  // namespace
}  // namespace wordgaze::evaluation
