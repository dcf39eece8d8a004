#include "wordgaze/training/trainer.hpp"

#include <gtest/gtest.h>

#include "wordgaze/evaluation/evaluator.hpp"

namespace wordgaze::training {
namespace {

/// A few hundred frames a second even with sanitizers.
TrainConfig small(int threads = 1) {
  TrainConfig c;
  c.env = "Wordgaze-One-N6-K2-v0";
  c.seed = 7;
  c.threads = threads;
  c.ppo.lanes = 8;
  c.ppo.steps = 10;
  c.ppo.chunk = 5;
  c.ppo.epochs = 2;
  c.ppo.minibatches = 2;
  c.probe_every = 2;
  return c;
}

TrainConfig small_two_clauses(int threads = 1) {
  TrainConfig c = small(threads);
  c.env = "Wordgaze-Two-N6-K3-v0";
  c.model.task_attention = true;
  c.curriculum.half_done_start = 0.5;
  c.curriculum.half_done_end = 0.5;
  c.curriculum.single_clause = 0.2;
  return c;
}

/// Episodes that the curriculum changes from the first one on.
TrainConfig small_changed() {
  TrainConfig c = small();
  c.curriculum.pickup_first = false;
  c.curriculum.stretch = 0.5;
  c.curriculum.huddle = 0.5;
  return c;
}

bool same_bits(const Agent::Params& a, const Agent::Params& b) {
  bool same = true;
  nn::for_each_parameter([&](const nn::Path&, const auto& x, const auto& y) { same &= x == y; }, a,
                         b);
  return same;
}

TrainConfig small_patches(int threads) {
  TrainConfig c = small(threads);
  c.model.encoder = model::Encoder::patch;
  return c;
}

struct TrainerVariant : testing::TestWithParam<TrainConfig> {};

TEST_P(TrainerVariant, TheSameSeedRepeatsARunBitForBit) {
  Trainer a(GetParam()), b(GetParam());
  for (int k = 0; k < 4; ++k) {
    const auto x = a.update().values(), y = b.update().values();
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (Metrics::columns()[i] == "seconds" || std::isnan(x[i])) continue;
      EXPECT_EQ(x[i], y[i]) << Metrics::columns()[i];
    }
  }
  EXPECT_TRUE(same_bits(a.params(), b.params()));
}

TEST_P(TrainerVariant, ARestoredRunGoesOnBitForBit) {
  Trainer whole(GetParam());
  for (int k = 0; k < 3; ++k) whole.update();
  Trainer resumed(GetParam());
  resumed.restore(whole.state());
  for (int k = 0; k < 3; ++k) {
    whole.update();
    resumed.update();
  }
  EXPECT_TRUE(same_bits(whole.params(), resumed.params()));
  EXPECT_EQ(whole.frames(), resumed.frames());
}

INSTANTIATE_TEST_SUITE_P(Settings, TrainerVariant,
                         testing::Values(small(1), small(2), small_changed(), small_two_clauses(1),
                                         small_two_clauses(2), small_patches(2)),
                         [](const auto& c) {
                           const bool patches = c.param.model.encoder == model::Encoder::patch;
                           return std::string(c.param.curriculum.pickup_first ? "" : "Changed") +
                                  (patches ? "Patches" : "") +
                                  (c.param.model.task_attention ? "Two" : "One") + "ClausesOn" +
                                  std::to_string(c.param.threads) + "Threads";
                         });

TEST(Trainer, ThreadsChangeTheLastBitsOnly) {
  Trainer one(small(1)), two(small(2));
  one.update();
  two.update();
  double worst = 0;
  nn::for_each_parameter(
      [&](const nn::Path&, const auto& x, const auto& y) {
        if (x.size() > 0) worst = std::max<double>(worst, (x - y).cwiseAbs().maxCoeff());
      },
      one.params(), two.params());
  // Adam turns a rounding difference of a gradient near zero into a step of up to the rate.
  EXPECT_LT(worst, 8.1e-3);
  EXPECT_NE(worst, 1);
}

TEST(Trainer, AnotherSeedIsAnotherRun) {
  TrainConfig other = small();
  other.seed = 8;
  EXPECT_FALSE(same_bits(Trainer(small()).params(), Trainer(other).params()));
}

TEST(Trainer, RefusesSettingsThatContradictEachOther) {
  TrainConfig c = small();
  c.ppo.chunk = 3;
  EXPECT_THROW(Trainer{c}, std::invalid_argument);
  c = small();
  c.ppo.minibatches = 5;
  EXPECT_THROW(Trainer{c}, std::invalid_argument);
  c = small();
  c.threads = 9;
  EXPECT_THROW(Trainer{c}, std::invalid_argument);
  c = small();
  c.env = "Wordgaze-One-N5-K40-v0";
  EXPECT_THROW(Trainer{c}, std::invalid_argument);
}

TEST(Trainer, TruncationIsBootstrapped) {
  // A critic that always says v, a policy of no success: the return of a truncated step must
  // contain discount * v. Terminations carry none of it.
  TrainConfig c = small();
  c.ppo.learning_rate = 0;
  c.curriculum = {.pickup_first = false, .balance = false};
  const babyai::LevelSpec level = [] {
    auto l = babyai::find_level("Wordgaze-One-N6-K2-auto-v0");
    l.max_steps = 3;
    return l;
  }();
  const Agent agent{c.model, model::CellAlphabet::one_room()};
  Agent::Params params = agent.make_params();
  params.critic.output.bias(0) = 10;
  Agent::Tables tables = agent.make_tables();
  agent.update_all_tables(params, tables);
  LaneGroup group(agent, c, level, 0, c.ppo.lanes);
  Rollout rollout(c.model, c.ppo);
  group.collect(params, tables, Curriculum(c.curriculum), rollout, nullptr);
  int ends = 0;
  for (Index n = 0; n < rollout.shape.columns(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    EXPECT_FLOAT_EQ(rollout.value[i], 10);
    if (rollout.ended[i] && rollout.reward[i] > 1) {
      EXPECT_FLOAT_EQ(rollout.reward[i], 9.9f);
      ++ends;
    } else {
      EXPECT_LE(rollout.reward[i], 1);
    }
  }
  EXPECT_GE(ends, 8);
}

TEST(Evaluation, DoesNotDependOnTheNumberOfWorkers) {
  Trainer trainer(small());
  const Evaluation evaluation{
      .level = babyai::find_level("Wordgaze-One-N6-K2-v0"), .episodes = 60, .lanes = 4};
  Team one(1), three(3);
  const auto a = evaluate(trainer.agent(), trainer.params(), evaluation, one);
  const auto b = evaluate(trainer.agent(), trainer.params(), evaluation, three);
  EXPECT_EQ(a.episodes, 60);
  EXPECT_EQ(a.successes, b.successes);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.episodes, a.successes + a.done_wrong + a.truncated);
}

TEST(WilsonInterval, MatchesPublishedValues) {
  const auto half = wilson_interval(50, 100);
  EXPECT_NEAR(half.low, 0.4038, 5e-5);
  EXPECT_NEAR(half.high, 0.5962, 5e-5);
  const auto all = wilson_interval(100, 100);
  EXPECT_NEAR(all.low, 0.9630, 5e-5);
  EXPECT_EQ(all.high, 1);
  EXPECT_EQ(wilson_interval(0, 100).low, 0);
}

}  // namespace
}  // namespace wordgaze::training
