#include <gtest/gtest.h>

#include "training/golden_update.hpp"

/// Single precision against double: the same learner, the same rollouts.
namespace wordgaze::training {
namespace {

using test::GoldenLearner;
using test::GoldenUpdate;

/// A learner in each precision, in step.
struct Both {
  GoldenLearner<float> single;
  GoldenLearner<double> exact;
  core::Rng order_of_single, order_of_exact;

  explicit Both(const GoldenUpdate& golden)
      : single(golden),
        exact(golden),
        order_of_single(golden.shuffler()),
        order_of_exact(golden.shuffler()) {}

  /// One update of both; the largest difference of what they report.
  double learn(const Rollout& rollout, const Rates& rates) {
    const auto a = single.learner.learn(rollout, rates, order_of_single);
    const auto b = exact.learner.learn(rollout, rates, order_of_exact);
    EXPECT_EQ(a.skipped + b.skipped, 0);
    double largest = std::abs(a.gradient_norm - b.gradient_norm) / (1 + b.gradient_norm);
    for (const auto& [name, value] : b.losses) {
      if (name == "clip_fraction") continue;  // one frame on the other side of the clip is 1 / N
      largest = std::max(largest, std::abs(a.of(name) - value) / (1 + std::abs(value)));
    }
    return largest;
  }

  /// Largest distance of two entries, as a share of the largest change of any.
  double distance() const {
    std::vector<Matrix<double>> singles;
    nn::for_each_parameter(
        [&](const nn::Path&, const auto& leaf) { singles.push_back(leaf.template cast<double>()); },
        single.learner.params());
    double largest = 0, change = 0;
    auto mine = singles.begin();
    nn::for_each_parameter(
        [&](const nn::Path&, const auto& leaf, const auto& before) {
          const auto& ours = *mine++;
          if (leaf.size() == 0) return;
          largest = std::max(largest, (ours - leaf).cwiseAbs().maxCoeff());
          change = std::max(change, (leaf - before).cwiseAbs().maxCoeff());
        },
        exact.learner.params(), exact.before);
    return largest / change;
  }
};

struct Precision : testing::TestWithParam<const char*> {
  GoldenUpdate golden{GetParam()};
};

TEST_P(Precision, AHundredUpdatesStayWithinATenThousandth) {
  Both both(golden);
  const Rollout rollout = golden.rollout();
  double largest = 0;
  for (int update = 0; update < 100; ++update) {
    largest = std::max(largest, both.learn(rollout, {1e-3, 2e-3, 0.01}));
  }
  EXPECT_LE(largest, 1e-4);
  EXPECT_LE(both.distance(), 1e-4);
  RecordProperty("reports", std::to_string(largest));
  RecordProperty("weights", std::to_string(both.distance()));
}

/// Rollouts at the edge of what there is.
Rollout with_missions(Rollout rollout, const babyai::Sentence& sentence) {
  for (auto& lane : rollout.missions) {
    for (auto& mission : lane) mission = sentence;
  }
  return rollout;
}

TEST_P(Precision, HoldsForMissionsOfOneWordAndOfPaddingAlone) {
  for (const int length : {1, 4}) {
    babyai::Sentence sentence;
    for (int i = 0; i < length; ++i) {
      sentence.append(length == 1 ? *babyai::word_id("ball") : babyai::kPadding, 0);
    }
    Both both(golden);
    const Rollout rollout = with_missions(golden.rollout(), sentence);
    for (int update = 0; update < 3; ++update) {
      EXPECT_LE(both.learn(rollout, {1e-3, 2e-3, 0.01}), 1e-4) << length << " words";
    }
    EXPECT_LE(both.distance(), 1e-2) << length << " words";
  }
}

TEST_P(Precision, HoldsForOneLaneAndOneStep) {
  golden.ppo.lanes = golden.ppo.steps = golden.ppo.chunk = golden.ppo.minibatches = 1;
  Rollout rollout(golden.model, golden.ppo);
  rollout.missions[0] = {babyai::sentence_of("go to the red ball")};
  rollout.cells.setOnes();
  rollout.log_prob[0] = -1.5f;
  rollout.value[0] = 0.3f;
  rollout.advantage[0] = 0.7f;
  Both both(golden);
  // The advantage of one frame is its own mean: the value alone says what to learn.
  for (int update = 0; update < 3; ++update) {
    EXPECT_LE(both.learn(rollout, {1e-3, 2e-3, 0.01}), 1e-4);
  }
  EXPECT_LE(both.distance(), 1e-2);
  EXPECT_GT((both.exact.learner.params().critic.output.bias - both.exact.before.critic.output.bias)
                .norm(),
            1e-4);
}

INSTANTIATE_TEST_SUITE_P(PyTorch, Precision, testing::Values("grounding", "task", "paper"),
                         [](const auto& variant) { return std::string(variant.param); });

}  // namespace
}  // namespace wordgaze::training
