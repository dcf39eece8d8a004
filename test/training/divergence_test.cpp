#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "support/messages.hpp"
#include "training/golden_update.hpp"

/// Numbers that are not finite: caught in the update where they arise, and named; and what the
/// learner holds stays good.
namespace wordgaze::training {
namespace {

using policy::Agent;
using test::GoldenUpdate;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool same_bits(const Agent::Params& a, const Agent::Params& b) {
  bool same = true;
  nn::for_each_parameter([&](const nn::Path&, const auto& x, const auto& y) { same &= x == y; }, a,
                         b);
  return same;
}

struct Divergence : testing::Test {
  GoldenUpdate golden{"task"};
  test::GoldenLearner<float> own{golden};
  Rollout rollout = golden.rollout();
  core::Rng rng = golden.shuffler();

  Learner<Agent>& learner() { return own.learner; }
  Learner<Agent>::Report learn(const Rates& rates) { return learner().learn(rollout, rates, rng); }
  /// What an update says that must fail, and that leaves weights and optimizer as they were.
  std::string failure(const Rates& rates) {
    const auto params = learner().params();
    const auto adam = learner().adam();
    const auto message = message_of<std::runtime_error>([&] { learn(rates); });
    EXPECT_TRUE(contains(message, "last checkpoint"));
    EXPECT_TRUE(contains(message, "--init"));
    EXPECT_TRUE(same_bits(params, learner().params()));
    EXPECT_TRUE(same_bits(adam.mean, learner().adam().mean));
    EXPECT_TRUE(same_bits(adam.variance, learner().adam().variance));
    EXPECT_EQ(adam.steps, learner().adam().steps);
    return message;
  }
};

TEST_F(Divergence, NamesTheNumberOfTheRollout) {
  learn(golden.rates(0));  // weights and moments worth keeping
  const Rollout good = rollout;
  const auto named = [&](float& number, float value, const char* name) {
    number = value;
    EXPECT_TRUE(contains(failure(golden.rates(1)), name));
    rollout = good;
  };
  named(rollout.start_h(1, 0), kNan, "the memory of step 0 in lane 0 is not finite");
  named(rollout.start_c(0, 4), -kInfinity, "the memory of step 4 in lane 1");
  named(rollout.value[5], kInfinity, "the value of step 1 in lane 2");
  named(rollout.next_value[1], kNan, "the value of step 8 in lane 1");
  named(rollout.log_prob[0], -kInfinity, "the log_prob of step 0 in lane 0");
  named(rollout.reward[23], kNan, "the reward of step 7 in lane 2");
  named(rollout.advantage[3], kNan, "the advantage of step 1 in lane 0");
  learn(golden.rates(1));  // and goes on
}

/// Of some minibatches, reports or asks for what no number is.
struct Nonsense final : Loss {
  float report, gradient;
  int bad;        // of how many batches
  int every = 1;  // and only each such one
  mutable int seen = 0;
  Nonsense(float r, float g, int n, int e = 1) : report(r), gradient(g), bad(n), every(e) {}
  static constexpr std::array<std::string_view, 1> kReports{"nonsense"};
  std::span<const std::string_view> reports() const override { return kReports; }
  void add(const Batch&, const model::Outputs<float>&, const Rates&, float,
           model::Outputs<float>& dy, std::span<double> sums) const override {
    if (seen++ >= bad || seen % every != 0) return;
    sums[0] += static_cast<double>(report);
    dy.values(0, 0) += gradient;
  }
};

TEST_F(Divergence, NamesTheLoss) {
  learner().add_loss(std::make_unique<Nonsense>(kNan, kNan, 1000));
  EXPECT_TRUE(contains(failure(golden.rates(0)), "every minibatch, nonsense is not finite"));
}

TEST_F(Divergence, NamesTheGradient) {
  learner().add_loss(std::make_unique<Nonsense>(0, kInfinity, 1000));
  EXPECT_TRUE(contains(failure(golden.rates(0)), "every minibatch, the gradient of '"));
}

TEST_F(Divergence, OneMinibatchIsLeftOutAndItsReportsWithIt) {
  learner().add_loss(std::make_unique<Nonsense>(kNan, kNan, 1));
  const auto report = learn(golden.rates(0));
  EXPECT_EQ(report.skipped, 1);
  for (const auto& [name, value] : report.losses) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_TRUE(nn::first_not_finite(learner().params()).empty());
}

TEST_F(Divergence, MinibatchesAreNotLeftOutForEver) {
  learner().add_loss(std::make_unique<Nonsense>(kNan, kNan, 1'000'000, 2));
  for (int k = 1; k < Learner<Agent>::kPatience; ++k) EXPECT_EQ(learn(golden.rates(0)).skipped, 3);
  EXPECT_TRUE(contains(failure(golden.rates(0)), "updates in a row, nonsense"));
}

TEST_F(Divergence, NothingIsLearnedFromWeightsOrMomentsThatAreNotGood) {
  const auto params = own.before;
  Learner<Agent>::Adam adam(params);
  const auto refused = [&](auto&& spoil, const char* name) {
    auto bad_params = params;
    auto bad_adam = adam;
    spoil(bad_params, bad_adam);
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] {
                           learner().restore(std::move(bad_params), std::move(bad_adam));
                         }),
                         name));
    EXPECT_TRUE(same_bits(params, learner().params()));
  };
  refused([](auto& p, auto&) { p.memory.bias(2) = kNan; }, "'memory.bias' is not finite");
  refused([](auto&, auto& a) { a.mean.words(1, 5) = -kInfinity; }, "'words', Adam's mean");
  refused([](auto&, auto& a) { a.variance.text.bias(0) = kNan; }, "'text.bias', Adam's variance");
  refused([](auto&, auto& a) { a.variance.text.bias(0) = kInfinity; }, "'text.bias', Adam's var");
  refused([](auto&, auto& a) { a.variance.critic.output.bias(0) = -1; }, "negative");
}

TEST_F(Divergence, NoLearningRateLeavesWhatIsNotFinite) {
  for (const double rate : {1e-30, 1e-3, 1.0, 1e4, 1e12, 1e30, 1e38, 1e200}) {
    test::GoldenLearner<float> fresh(golden);
    int updates = 0;
    try {
      for (; updates < 20; ++updates) fresh.learner.learn(rollout, {rate, rate, 0.01}, rng);
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(contains(error.what(), "diverged")) << rate;
    }
    EXPECT_TRUE(rate > 1 || updates == 20) << rate;
    EXPECT_TRUE(rate < 1e38 || updates < 20) << rate;
    EXPECT_EQ(nn::first_not_finite(fresh.learner.params()), "") << rate;
    EXPECT_EQ(nn::first_not_finite(fresh.learner.adam().mean), "") << rate;
    EXPECT_EQ(nn::first_not_finite(fresh.learner.adam().variance), "") << rate;
  }
}

TEST_F(Divergence, ALearningRateOfZeroLearnsNothing) {
  learn({0, 0, 0.01});
  EXPECT_TRUE(same_bits(own.before, learner().params()));
}

}  // namespace
}  // namespace wordgaze::training
