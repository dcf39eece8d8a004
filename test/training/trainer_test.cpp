#include "wordgaze/training/trainer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

bool same_bits(const policy::Agent::Params& a, const policy::Agent::Params& b) {
  bool same = true;
  nn::for_each_parameter([&](const nn::Path&, const auto& x, const auto& y) { same &= x == y; }, a,
                         b);
  return same;
}

TrainConfig small_patches(int threads) {
  TrainConfig c = small(threads);
  c.model.encoder = model::Encoder::patch;
  c.model.gaze = model::Gaze::sum;
  return c;
}

TEST(Focus, GrowsFromItsStartToItsEnd) {
  TrainConfig c;
  c.frames = 100;
  c.ppo.focus_start = 0.4;
  c.ppo.focus_end = 0.8;
  EXPECT_EQ(focus_at(c, 0), 0);
  EXPECT_EQ(focus_at(c, 40), 0);
  EXPECT_NEAR(focus_at(c, 60), 0.5, 1e-12);
  EXPECT_EQ(focus_at(c, 80), 1);
  c.ppo.focus_start = c.ppo.focus_end = 0;
  EXPECT_EQ(focus_at(c, 0), 1);
}

TEST(Focus, NeverFalls) {
  Trainer first(small());
  auto params = first.params();
  EXPECT_EQ(params.attention.focus(0), 0);
  params.attention.focus(0) = 1;
  Trainer second(small());
  second.set_params(params);
  second.update();
  EXPECT_EQ(second.params().attention.focus(0), 1);
}

TEST(Trainer, TrainsWhereFewerActionsArePossible) {
  TrainConfig c = small(2);
  c.env = "MiniGrid-Dynamic-Obstacles-5x5-v0";
  Trainer trainer(c);
  const auto impossible = [&] { return trainer.params().actor.output.bias.tail(4).eval(); };
  const auto before = impossible();
  for (int k = 0; k < 3; ++k) {
    const Metrics m = trainer.update();
    EXPECT_LE(m.entropy, std::log(3.0) + 1e-6);
    EXPECT_EQ(m.skipped, 0);
  }
  EXPECT_EQ(impossible(), before);
}

TEST(Trainer, TrainsWithoutMissions) {
  TrainConfig c = small(2);
  c.env = "MiniGrid-Playground-v0";
  c.model.task_attention = true;
  Trainer trainer(c);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(trainer.update().skipped, 0);
}

struct TrainerVariant : testing::TestWithParam<TrainConfig> {};

TEST_P(TrainerVariant, TheSameSeedRepeatsARunBitForBit) {
  Trainer a(GetParam()), b(GetParam());
  for (int k = 0; k < 4; ++k) {
    const Metrics one = a.update(), two = b.update();
    const auto x = one.values(), y = two.values();
    const auto columns = a.columns();
    EXPECT_EQ(columns, one.columns());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (columns[i] == "seconds" || std::isnan(x[i])) continue;
      EXPECT_EQ(x[i], y[i]) << columns[i];
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
  // Adam turns a rounding difference of a gradient near zero into a step of up to the rate. So few
  // steps at a tiny rate: what the threads change is then a share of what the update changed.
  TrainConfig config = small(1);
  config.ppo.epochs = 1;
  Trainer one(config);
  config.threads = 2;
  Trainer two(config);
  const auto before = one.params();
  one.update();
  two.update();
  nn::for_each_parameter(
      [&](const nn::Path& path, const auto& start, const auto& x, const auto& y) {
        if (x.size() == 0) return;
        EXPECT_LE((x - y).norm(), 0.02 * (x - start).norm()) << path.str();
      },
      before, one.params(), two.params());
}

TEST(Trainer, TheTaskModuleLearnsAtItsOwnRate) {
  TrainConfig config = small_two_clauses();
  config.ppo.task_learning_rate = 0;
  Trainer still(config);
  const auto before = still.params();
  still.update();
  EXPECT_EQ(before.task.scan.words, still.params().task.scan.words);
  EXPECT_EQ(before.task.scan.rules, still.params().task.scan.rules);
  EXPECT_NE(before.words, still.params().words);
  config.ppo.task_learning_rate = 1e-3;
  config.ppo.learning_rate = 0;
  Trainer task(config);
  task.update();
  EXPECT_NE(before.task.scan.words, task.params().task.scan.words);
  EXPECT_EQ(before.words, task.params().words);
  EXPECT_EQ(before.actor.output.weight, task.params().actor.output.weight);
}

TEST(Trainer, ALevelWithoutObjectsToCrowdIsNotProbed) {
  for (const char* id : {"MiniGrid-MultiRoom-N6-v0", "MiniGrid-LavaCrossingS9N1-v0"}) {
    TrainConfig config = small();
    config.env = id;
    config.ppo.minibatches = 1;
    config.curriculum = {.pickup_first = false, .balance = false, .stretch = 0, .huddle = 0};
    EXPECT_FALSE(crowded(babyai::find_level(id))) << id;
    Trainer trainer(config);
    EXPECT_TRUE(std::isnan(trainer.update().hit_12)) << id;
  }
  EXPECT_TRUE(crowded(babyai::find_level("Wordgaze-One-N8-K4-v0")));
}

/// Counts what it is told.
struct Counter final : policy::Observer {
  std::vector<std::int64_t> begun, ended, updates;
  int steps = 0;
  std::size_t scalars = 0;
  bool wants_episode(std::int64_t) override { return true; }
  void on_begin(const policy::EpisodeBegin& b) override { begun.push_back(b.episode); }
  void on_step(const policy::StepRecord&) override { ++steps; }
  void on_end(const policy::EpisodeEnd& e) override { ended.push_back(e.episode); }
  void on_update(const policy::UpdateRecord& u) override {
    updates.push_back(u.update);
    scalars = u.scalars.size();
  }
};

TEST(Trainer, TellsItsObserverOfEpisodesAndMetrics) {
  Trainer trainer(small()), alone(small());
  Counter counter;
  for (int k = 0; k < 6; ++k) {
    trainer.update(&counter);
    alone.update();
  }
  EXPECT_EQ(counter.updates, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(counter.scalars, trainer.columns().size());
  EXPECT_EQ(counter.steps, 60);  // every step of the first lane
  ASSERT_GE(counter.begun.size(), 2u);
  EXPECT_TRUE(std::is_sorted(counter.begun.begin(), counter.begun.end()));
  EXPECT_GE(counter.begun.size(), counter.ended.size());
  EXPECT_LE(counter.begun.size(), counter.ended.size() + 1);
  EXPECT_TRUE(same_bits(trainer.params(), alone.params())) << "being watched changes nothing";
}

/// Asks for what no number is.
struct Nonsense final : Loss {
  int bad;  // of how many batches; then all is well
  mutable int seen = 0;
  explicit Nonsense(int n) : bad(n) {}
  std::span<const std::string_view> reports() const override { return {}; }
  void add(const Batch&, const model::Outputs<float>&, const Rates&, float,
           model::Outputs<float>& gradient, std::span<double>) const override {
    if (seen++ < bad) gradient.values(0, 0) = std::numeric_limits<float>::quiet_NaN();
  }
};

TEST(Trainer, LeavesOutMinibatchesWithoutAFiniteGradient) {
  Trainer trainer(small());
  trainer.add_loss(std::make_unique<Nonsense>(1));
  const auto metrics = trainer.update();
  EXPECT_EQ(metrics.skipped, 1);
  EXPECT_TRUE(std::isfinite(metrics.gradient_norm));
  nn::for_each_parameter(
      [](const nn::Path& path, const auto& leaf) { EXPECT_TRUE(leaf.allFinite()) << path.str(); },
      trainer.params());
}

TEST(Trainer, SaysWhenItHasDiverged) {
  Trainer trainer(small());
  const auto before = trainer.params();
  trainer.add_loss(std::make_unique<Nonsense>(1000));
  EXPECT_THROW(trainer.update(), std::runtime_error);
  EXPECT_TRUE(same_bits(before, trainer.params()));
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
  const policy::Agent agent{c.model, model::CellAlphabet::one_room()};
  auto params = agent.make_params();
  params.critic.output.bias(0) = 10;
  const auto weights = agent.make_weights(std::move(params));
  LaneGroup group(
      std::make_unique<policy::NetworkPolicy<policy::Agent>>(agent, weights, c.ppo.lanes), c, level,
      0);
  Rollout rollout(c.model, c.ppo);
  group.collect(Curriculum(c.curriculum), rollout, nullptr);
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
  const evaluation::Evaluation evaluation{
      .level = babyai::find_level("Wordgaze-One-N6-K2-v0"), .episodes = 60, .lanes = 4};
  const auto make = evaluation::policy_factory(trainer.agent(), trainer.weights());
  Team one(1), three(3);
  const auto a = evaluation::evaluate(make, evaluation, one);
  const auto b = evaluation::evaluate(make, evaluation, three);
  EXPECT_EQ(a.episodes, 60);
  EXPECT_EQ(a.successes, b.successes);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.episodes, a.successes + a.done_wrong + a.truncated);
}

}  // namespace
}  // namespace wordgaze::training
