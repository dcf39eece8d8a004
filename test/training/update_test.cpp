#include <gtest/gtest.h>

#include "training/golden_update.hpp"

/// Whole updates against PyTorch, which has its own network, losses, advantages, minibatches,
/// clipping and Adam (scripts/golden/update.py).
template struct wordgaze::model::Agent<double>;
template class wordgaze::training::Learner<wordgaze::model::Agent<double>>;

namespace wordgaze::training {
namespace {

using test::GoldenLearner;
using test::GoldenUpdate;
using test::Json;

struct Update : testing::TestWithParam<const char*> {
  GoldenUpdate golden{GetParam()};
};

TEST_P(Update, AgreesOnAdvantages) {
  const Rollout rollout = golden.rollout();
  const Json& theirs = golden.json.at("rollout").at("advantage");
  for (Index n = 0; n < rollout.shape.columns(); ++n) {
    const double expected = theirs.at(static_cast<std::size_t>(n % rollout.shape.batch))
                                .at(static_cast<std::size_t>(n / rollout.shape.batch));
    EXPECT_NEAR(rollout.advantage[static_cast<std::size_t>(n)], expected, 1e-6);
  }
}

/// Two updates; `tolerance` is absolute for what is reported, and for the change of a tensor a
/// share of its largest entry.
template <class S>
void expect_their_updates(const GoldenUpdate& golden, int workers, double tolerance) {
  const Rollout rollout = golden.rollout();
  GoldenLearner<S> ours(golden, workers);
  core::Rng shuffler = golden.shuffler();
  for (std::size_t u = 0; u < golden.json.at("rates").size(); ++u) {
    const auto report = ours.learner.learn(rollout, golden.rates(u), shuffler);
    EXPECT_EQ(report.skipped, 0);
    const Json& theirs = golden.json.at("reports").at(u);
    const auto agrees = [&](const char* name, double value) {
      EXPECT_NEAR(value, theirs.at(name), tolerance) << name << " of update " << u;
    };
    agrees("policy", report.of("policy_loss"));
    agrees("value", report.of("value_loss"));
    agrees("entropy", report.of("entropy"));
    agrees("divergence", report.of("kl"));
    agrees("clipped", report.of("clip_fraction"));
    agrees("norm", report.gradient_norm);
    if (golden.model.task_attention) agrees("mask", report.of("mask_loss"));
  }
  std::size_t leaves = 0;
  nn::for_each_parameter(
      [&](const nn::Path& path, const auto& after, const auto& before) {
        if (after.size() == 0) return;
        ++leaves;
        const Matrix<double> theirs =
            test::matrix(golden.json.at("changes").at(path.str()), after.rows(), after.cols());
        const Matrix<double> change =
            after.template cast<double>() - before.template cast<double>();
        EXPECT_LE((change - theirs).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
                  tolerance * theirs.cwiseAbs().maxCoeff())
            << path.str() << " of " << workers << " workers";
      },
      ours.learner.params(), ours.before);
  EXPECT_EQ(leaves, golden.json.at("changes").size());
}

TEST_P(Update, AgreesInDoublePrecision) {
  // Advantages are single precision, and Adam divides by small gradients.
  for (const int workers : {1, 2, 3}) expect_their_updates<double>(golden, workers, 1e-5);
}

TEST_P(Update, AgreesInSinglePrecision) { expect_their_updates<float>(golden, 1, 1e-4); }

INSTANTIATE_TEST_SUITE_P(PyTorch, Update, testing::Values("grounding", "task", "paper"),
                         [](const auto& variant) { return std::string(variant.param); });

}  // namespace
}  // namespace wordgaze::training
