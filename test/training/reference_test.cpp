#include <gtest/gtest.h>

#include "support/golden.hpp"
#include "wordgaze/optim/adam.hpp"
#include "wordgaze/training/gae.hpp"
#include "wordgaze/training/mask_loss.hpp"
#include "wordgaze/training/ppo_loss.hpp"

/// What the agent learns from, against PyTorch (scripts/golden/ppo.py).
namespace wordgaze::training {
namespace {

using test::Json;
using test::relative_error;

constexpr double kTolerance = 1e-12;

Json reference(const char* part) { return test::golden("training/ppo.json").at(part); }

/// The file has a list a lane, the rollout a block a step.
template <class T>
std::vector<T> time_major(const Json& lanes) {
  const Matrix<double> m =
      test::matrix(lanes, static_cast<Index>(lanes.size()), static_cast<Index>(lanes.at(0).size()));
  return {m.data(), m.data() + m.size()};
}

TEST(PyTorch, AgreesOnAdvantages) {
  const Json j = reference("advantages");
  const auto lanes = static_cast<Index>(j.at("reward").size());
  const auto steps = static_cast<Index>(j.at("reward").at(0).size());
  std::vector<float> ours(static_cast<std::size_t>(lanes * steps));
  estimate_advantages({steps, lanes}, time_major<float>(j.at("reward")),
                      time_major<float>(j.at("value")), time_major<std::uint8_t>(j.at("ended")),
                      j.at("next_value").get<std::vector<float>>(), j.at("discount"),
                      j.at("lambda"), ours);
  const auto theirs = time_major<double>(j.at("advantage"));
  // Advantages are single precision.
  for (std::size_t n = 0; n < ours.size(); ++n) EXPECT_NEAR(ours[n], theirs[n], 1e-5);
}

TEST(PyTorch, AgreesOnTheClippedObjectiveAndItsGradient) {
  const Json j = reference("ppo_loss");
  const auto frames = static_cast<Index>(j.at("action").size());
  const Matrix<double> logits = test::matrix(j.at("logits"), frames, grid::kActions).transpose();
  const PpoLoss<double> loss{.clip = j.at("clip"),
                             .value_coefficient = j.at("value_coefficient"),
                             .entropy_coefficient = j.at("entropy_coefficient")};
  Matrix<double> dlogits = Matrix<double>::Zero(grid::kActions, frames);
  Matrix<double> dvalues = Matrix<double>::Zero(1, frames);
  PpoLoss<double>::Sums sums;
  for (Index n = 0; n < frames; ++n) {
    const auto of_frame = [&](const char* name) {
      return j.at(name).at(static_cast<std::size_t>(n));
    };
    loss.add(
        {of_frame("action"), of_frame("old_log_prob"), of_frame("advantage"), of_frame("target")},
        {logits.col(n).data(), grid::kActions}, of_frame("value"), 1 / static_cast<double>(frames),
        {dlogits.col(n).data(), grid::kActions}, dvalues(0, n), sums);
  }
  EXPECT_LE(
      relative_error(dlogits.transpose(), test::matrix(j.at("dlogits"), frames, grid::kActions)),
      kTolerance);
  EXPECT_LE(relative_error(dvalues.transpose(), test::column(j.at("dvalue"))), kTolerance);
  const auto mean = [&](double sum) { return sum / static_cast<double>(frames); };
  const Json& parts = j.at("parts");
  EXPECT_NEAR(mean(sums.policy), parts.at("policy"), kTolerance);
  EXPECT_NEAR(mean(sums.value), parts.at("value"), kTolerance);
  EXPECT_NEAR(mean(sums.entropy), parts.at("entropy"), kTolerance);
  EXPECT_NEAR(mean(sums.divergence), parts.at("divergence"), kTolerance);
  EXPECT_NEAR(mean(sums.clipped), parts.at("clipped"), kTolerance);
}

TEST(PyTorch, AgreesOnTheTaskAttentionLossAndItsGradient) {
  const Json j = reference("mask_loss");
  babyai::Sentence sentence;
  for (const int clause : j.at("clause_of")) sentence.append(1, clause);
  std::uint8_t bright = 0;
  for (std::size_t i = 0; i < j.at("bright").size(); ++i) {
    bright |= static_cast<std::uint8_t>(j.at("bright").at(i).get<int>() << i);
  }
  const Vector<double> alpha = test::column(j.at("alpha"));
  Vector<double> dlogits = Vector<double>::Zero(alpha.size());
  EXPECT_NEAR(mask_loss(sentence, bright, alpha, 1, dlogits), j.at("loss"), kTolerance);
  EXPECT_LE(relative_error(dlogits, test::column(j.at("dlogits"))), kTolerance);
}

/// Two leaves that learn at different rates.
struct Pair {
  Vector<double> first, second;
  static constexpr auto fields() {
    return std::tuple{nn::Field{"first", &Pair::first}, nn::Field{"second", &Pair::second}};
  }
};

TEST(PyTorch, AgreesOnAdam) {
  const Json j = reference("adam");
  const auto pair = [](const Json& leaves) {
    return Pair{test::column(leaves.at(0)), test::column(leaves.at(1))};
  };
  Pair params = pair(j.at("before"));
  optim::Adam<Pair> adam(params);
  for (const auto& gradients : j.at("gradients")) {
    adam.step(params, pair(gradients), [&](const nn::Path& path) {
      return j.at("rates").at(path.names[0] == "second").get<double>();
    });
  }
  const Pair after = pair(j.at("after"));
  EXPECT_LE(relative_error(params.first, after.first), kTolerance);
  EXPECT_LE(relative_error(params.second, after.second), kTolerance);
}

}  // namespace
}  // namespace wordgaze::training
