#include "wordgaze/training/learner.hpp"

#include <gtest/gtest.h>

#include "wordgaze/model/reference.hpp"
#include "wordgaze/nn/gradient_check.hpp"

/// The learner alone, on a rollout that no environment has made, held against the loss written a
/// second time from docs/math.md, in double, over the network without tables.
namespace wordgaze::training {
namespace {

using Network = model::Agent<float>;
using Twin = model::Agent<double>;

constexpr int kLanes = 3, kSteps = 6;

model::Config tiny(bool task_attention) {
  model::Config c;
  c.task_attention = task_attention;
  c.channels = c.word_size = c.key_size = 3;
  c.memory_size = c.text_size = c.head_size = c.task_size = 4;
  c.task_words = 14;
  c.sub_tasks = 2;
  c.score_cost_start = c.score_cost = 0;
  return c;
}

PpoConfig whole_rollout_at_once() {
  PpoConfig ppo;
  ppo.lanes = kLanes;
  ppo.steps = kSteps;
  ppo.chunk = 3;  // two training sequences a lane: the second starts from a stored memory
  ppo.epochs = 1;
  ppo.minibatches = 1;
  ppo.gradient_norm = 1e6;
  ppo.advantage_floor = 0.01;
  ppo.mask_coefficient = 0.7;
  ppo.value_coefficient = 0.3;
  return ppo;
}

/// Two clauses: the words of each, and a comma between them that belongs to neither.
babyai::Sentence two_clauses(const char* first, const char* second) {
  babyai::Sentence s = babyai::sentence_of(first, 0);
  s.append(*babyai::word_id(","), -1);
  for (const auto word : babyai::sentence_of(second, 1)) s.append(word, 1);
  return s;
}

/// Episodes that end and begin within sequences, several missions, memories, c_t, true masks.
Rollout drawn_rollout(const model::Config& config, const PpoConfig& ppo, core::Rng& rng) {
  Rollout r(config, ppo);
  const auto real = [&] { return static_cast<float>(2 * rng.uniform() - 1); };
  const std::vector<babyai::Sentence> missions{
      babyai::sentence_of("go to the red ball"),
      two_clauses("pick up the blue key", "then go to the grey box")};
  for (int lane = 0; lane < kLanes; ++lane) {
    auto& own = r.missions[static_cast<std::size_t>(lane)];
    own = {missions[static_cast<std::size_t>(lane) % 2]};
    for (Index t = 0; t < kSteps; ++t) {
      const Index column = r.shape.column(t, lane);
      const auto n = static_cast<std::size_t>(column);
      const bool begins = (t + 2 * lane) % 4 == 0;
      if (begins && t > 0) own.push_back(missions[(own.size() + n) % 2]);
      r.keep(0, column) = begins ? 0.0f : 1.0f;
      r.mission_of[n] = static_cast<int>(own.size()) - 1;
      for (Index cell = 0; cell < grid::kViewCells; ++cell) {
        r.cells(cell, column) = static_cast<std::uint8_t>(rng.below(rng.below(3) == 0 ? 21 : 3));
      }
      for (Index i = 0; i < config.sub_tasks; ++i) {
        r.completion(i, column) = static_cast<float>(rng.below(2));
      }
      r.action[n] = static_cast<std::uint8_t>(rng.below(grid::kActions));
      r.bright[n] = static_cast<std::uint8_t>(rng.below(4));
      r.log_prob[n] = -1.9f + 0.4f * real();  // ratios on both sides of the clip
      r.value[n] = real();
      r.advantage[n] = real();
    }
  }
  for (auto* m : {&r.start_h, &r.start_c}) {
    for (Index i = 0; i < m->size(); ++i) m->data()[i] = real();
  }
  return r;
}

/// The loss of a rollout as one minibatch.
double plain_loss(const model::Design& design, const Twin::Params& params, const Rollout& r,
                  const PpoConfig& ppo, const Rates& rates) {
  const auto frames = static_cast<double>(r.shape.columns());
  double mean = 0, square = 0;
  for (const float a : r.advantage) mean += static_cast<double>(a) / frames;
  for (const float a : r.advantage) square += std::pow(static_cast<double>(a) - mean, 2) / frames;
  const double deviation = std::max(std::sqrt(square), ppo.advantage_floor);
  double loss = 0;
  for (int s = 0; s < r.sequences(); ++s) {
    model::Frames<double> x;
    model::Missions missions;
    x.resize(design.config, {r.chunk, 1});
    x.start.h = r.start_h.col(s).cast<double>();
    x.start.c = r.start_c.col(s).cast<double>();
    for (Index t = 0; t < r.chunk; ++t) {
      const Index from = r.column(s, t);
      x.cells.col(t) = r.cells.col(from);
      x.keep(0, t) = static_cast<double>(r.keep(0, from));
      x.completion.col(t) = r.completion.col(from).cast<double>();
      model::Mission mission{r.mission(r.lane(s), from), {}};
      for (std::size_t i = 0; model::scans(design.config) && i < 2; ++i) {
        mission.done[i] = r.completion(static_cast<Index>(i), from) > 0;
      }
      x.mission_of[static_cast<std::size_t>(t)] = missions.index_of(mission);
    }
    const auto out = model::ReferenceAgent<double>{design, params}.run(x, missions);
    for (Index t = 0; t < r.chunk; ++t) {
      const auto n = static_cast<std::size_t>(r.column(s, t));
      const Vector<double> p =
          out.logits.col(t).array().exp() / out.logits.col(t).array().exp().sum();
      const double ratio = p(r.action[n]) / std::exp(static_cast<double>(r.log_prob[n]));
      const double a = (static_cast<double>(r.advantage[n]) - mean) / deviation;
      const double target = static_cast<double>(r.advantage[n]) + static_cast<double>(r.value[n]);
      loss -= std::min(ratio * a, std::clamp(ratio, 1 - ppo.clip, 1 + ppo.clip) * a);
      loss += ppo.value_coefficient * std::pow(out.values(0, t) - target, 2);
      loss += rates.entropy_coefficient * (p.array() * p.array().log()).sum();
      if (!design.config.task_attention) continue;
      const auto& mission = missions[x.mission(t)];
      for (int i = 0; i < mission.length; ++i) {
        const int sub_task = mission.sub_task_of[static_cast<std::size_t>(i)];
        const bool bright = sub_task >= 0 && (r.bright[n] >> sub_task) % 2 == 1;
        const double alpha = out.mask(i, t);
        loss -= ppo.mask_coefficient * std::log(bright ? alpha : 1 - alpha) / mission.length;
      }
    }
  }
  return loss / frames;
}

struct LearnerPhase : testing::TestWithParam<bool> {};

TEST_P(LearnerPhase, FollowsTheGradientOfTheWholeLoss) {
  const model::Config config = tiny(GetParam());
  const PpoConfig ppo = whole_rollout_at_once();
  const Network agent(config, model::CellAlphabet::one_room());
  core::Rng rng(7);  // no ratio within a step of the clip, where the loss has a corner
  const auto params = agent.initialize(rng);
  const Rollout rollout = drawn_rollout(config, ppo, rng);
  const Rates rates{.learning_rate = 0, .task_learning_rate = 0, .entropy_coefficient = 0.05};
  for (const int workers : {1, 2}) {
    Team team(workers);
    Learner<Network> learner(agent, ppo, make_losses(config, ppo), params, team);
    core::Rng order(1);
    learner.learn(rollout, rates, order);

    Twin::Params twin = Twin(config, agent.alphabet).make_params();
    Twin::Params grads = twin;
    const auto widen = [](const auto& from, auto& to) {
      std::vector<Vector<double>> leaves;
      nn::for_each_parameter(
          [&](const nn::Path&, const auto& leaf) {
            leaves.push_back(
                Eigen::Map<const Vector<float>>(leaf.data(), leaf.size()).template cast<double>());
          },
          from);
      std::size_t k = 0;
      nn::for_each_parameter(
          [&](const nn::Path&, auto& leaf) {
            Eigen::Map<Vector<double>>(leaf.data(), leaf.size()) = leaves[k++];
          },
          to);
    };
    widen(params, twin);
    widen(learner.adam().mean, grads);  // after one step: a tenth of the gradient
    nn::for_each_parameter([](const nn::Path&, auto& leaf) { leaf *= 10; }, grads);
    int checked = 0;
    nn::for_each_parameter(
        [&](const nn::Path& path, auto& leaf, const auto& gradient) {
          if (path.str() == "attention.focus") return;  // set, not learned
          const double largest = leaf.size() > 0 ? gradient.cwiseAbs().maxCoeff() : 0;
          for (Index i = 0; i < leaf.size(); i += 1 + leaf.size() / 20) {
            const double kept = leaf.data()[i], step = 1e-5;
            leaf.data()[i] = kept + step;
            const double above = plain_loss(agent, twin, rollout, ppo, rates);
            leaf.data()[i] = kept - step;
            const double below = plain_loss(agent, twin, rollout, ppo, rates);
            leaf.data()[i] = kept;
            // The learner is single precision.
            EXPECT_NEAR((above - below) / (2 * step), gradient.data()[i], 1e-5 + 1e-3 * largest)
                << path.str() << "[" << i << "], " << workers << " workers";
            ++checked;
          }
        },
        twin, grads);
    EXPECT_GT(checked, 200);
  }
}
INSTANTIATE_TEST_SUITE_P(Phases, LearnerPhase, testing::Bool(), [](const auto& phase) {
  return phase.param ? "WithTheTaskAttentionModule" : "Grounding";
});

TEST(Learner, MakesWhatPaidMoreLikelyAndLearnsWhatToExpect) {
  const model::Config config = tiny(false);
  PpoConfig ppo = whole_rollout_at_once();
  ppo.epochs = 10;
  const Network agent(config, model::CellAlphabet::one_room());
  core::Rng rng(5);
  Rollout rollout = drawn_rollout(config, ppo, rng);
  for (std::size_t n = 0; n < rollout.action.size(); ++n) {
    rollout.advantage[n] = rollout.action[n] == 2 ? 1.0f : -1.0f;
    rollout.value[n] = 3 - rollout.advantage[n];  // every return is 3
    rollout.log_prob[n] = std::log(1.0f / grid::kActions);
  }
  Team team(1);
  Learner<Network> learner(agent, ppo, make_losses(config, ppo), agent.initialize(rng), team);
  const Rates rates{.learning_rate = 3e-3, .task_learning_rate = 0, .entropy_coefficient = 0};
  const auto first = learner.learn(rollout, rates, rng);
  const auto later = learner.learn(rollout, rates, rng);
  EXPECT_LT(later.of("policy_loss"), first.of("policy_loss"));
  EXPECT_LT(later.of("value_loss"), first.of("value_loss"));
  EXPECT_TRUE(std::isnan(first.of("mask_loss")));
  EXPECT_EQ(first.skipped, 0);
  const auto& bias = learner.params().actor.output.bias;
  EXPECT_EQ(bias.maxCoeff(), bias(2));
}

}  // namespace
}  // namespace wordgaze::training
