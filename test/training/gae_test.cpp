#include "wordgaze/training/gae.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace wordgaze::training {
namespace {

/// One lane; `ended` marks the last steps of episodes.
std::vector<float> advantages(std::vector<float> reward, std::vector<float> value,
                              std::vector<std::uint8_t> ended, float next_value, float discount,
                              float lambda) {
  std::vector<float> advantage(reward.size());
  const nn::SequenceShape shape{static_cast<Index>(reward.size()), 1};
  estimate_advantages(shape, reward, value, ended, std::vector<float>{next_value}, discount, lambda,
                      advantage);
  return advantage;
}

TEST(Gae, IsTheDiscountedSumOfSurprises) {
  const float g = 0.9f, l = 0.8f;
  const std::vector<float> r{1, 2, 3}, v{0.5f, -1, 2};
  const auto a = advantages(r, v, {0, 0, 0}, 4, g, l);
  const float d2 = 3 + g * 4 - 2, d1 = 2 + g * 2 + 1, d0 = 1 + g * -1 - 0.5f;
  EXPECT_FLOAT_EQ(a[2], d2);
  EXPECT_FLOAT_EQ(a[1], d1 + g * l * d2);
  EXPECT_FLOAT_EQ(a[0], d0 + g * l * (d1 + g * l * d2));
}

TEST(Gae, NothingFlowsBackOverAnEpisodesEnd) {
  const auto a = advantages({1, 2, 300}, {0.5f, -1, 2}, {0, 1, 0}, 400, 0.9f, 0.8f);
  const auto b = advantages({1, 2, 0}, {0.5f, -1, 7}, {0, 1, 0}, 0, 0.9f, 0.8f);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[1], b[1]);
  EXPECT_FLOAT_EQ(a[1], 2 + 1);
}

TEST(Gae, LanesDoNotMix) {
  const nn::SequenceShape shape{2, 2};
  const std::vector<float> reward{1, 5, 2, 6}, value{0, 0, 0, 0}, next{0, 0};
  const std::vector<std::uint8_t> ended(4);
  std::vector<float> advantage(4);
  estimate_advantages(shape, reward, value, ended, next, 1, 1, advantage);
  EXPECT_EQ(advantage, (std::vector<float>{3, 11, 2, 6}));
}

}  // namespace
}  // namespace wordgaze::training
