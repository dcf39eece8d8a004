#include "wordgaze/lcm/convert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <numeric>

#include "lcm/example_records.hpp"
#include "support/messages.hpp"

namespace wordgaze::lcm_io {
namespace {

const Origin kOrigin{"run 1", "a.safetensors"};

/// Sends a message through LCM's own machinery and gives back what arrives.
template <class Message>
Message through_lcm(const Message& message) {
  // A function: LCM's call of a member function trips over g++ 12's undefined-behavior sanitizer.
  const auto hear = [](const lcm::ReceiveBuffer*, const std::string&, const Message* arrived,
                       std::vector<Message>* heard) { heard->push_back(*arrived); };
  using Hear = void (*)(const lcm::ReceiveBuffer*, const std::string&, const Message*,
                        std::vector<Message>*);
  std::vector<Message> heard;
  lcm::LCM bus("memq://");
  bus.subscribeFunction("CHANNEL", static_cast<Hear>(hear), &heard);
  bus.publish("CHANNEL", &message);
  bus.handle();
  EXPECT_EQ(heard.size(), 1u);
  return heard.at(0);
}

TEST(Convert, EpisodeBeginArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_message(records.begin(12), kOrigin, 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.episode_id, 12);
  EXPECT_EQ(message.env_index, 3);
  EXPECT_EQ(message.env_id, "Wordgaze-One-N8-K4-v0");
  EXPECT_EQ(static_cast<std::uint64_t>(message.seed), 18446744073709551615u);
  EXPECT_EQ(message.mission, "pick up the blue key");
  EXPECT_EQ(message.num_tokens, 5);
  EXPECT_EQ(message.tokens, (std::vector<std::string>{"pick", "up", "the", "blue", "key"}));
  EXPECT_EQ(message.token_ids[3], babyai::word_id("blue"));
  EXPECT_EQ(message.max_steps, 128);
  EXPECT_EQ(message.run_id, "run 1");
  EXPECT_EQ(message.checkpoint, "a.safetensors");
}

TEST(Convert, TheWorldArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_world_message(records.scene(12, 9), 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.episode_id, 12);
  EXPECT_EQ(message.step, 9);
  EXPECT_EQ(message.width, 3);
  EXPECT_EQ(message.height, 2);
  EXPECT_TRUE(std::ranges::equal(message.cells, records.cells));
  EXPECT_EQ(message.agent_x, 1);
  EXPECT_EQ(message.agent_y, 0);
  EXPECT_EQ(message.direction, 2);
  EXPECT_EQ(message.carried[0], 5);
  EXPECT_EQ(message.carried[1], 2);
}

TEST(Convert, TheProgressArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_progress_message(records.scene(12, 9), 1234567));
  EXPECT_EQ(message.step, 9);
  EXPECT_TRUE(std::ranges::equal(message.completed, records.completion));
  EXPECT_TRUE(std::ranges::equal(message.enabled, records.enabled));
  EXPECT_EQ(message.sub_task_of, std::vector<std::int8_t>(5, 0));
  EXPECT_EQ(message.target_x, (std::vector<std::int16_t>{1, 2}));
  EXPECT_EQ(message.target_y, (std::vector<std::int16_t>{1, 1}));
}

TEST(Convert, RefusesAWorldWhoseSizeIsAnother) {
  const ExampleRecords records;
  auto scene = records.scene(1);
  scene.width = 4;
  EXPECT_TRUE(contains(message_of<std::invalid_argument>([&] { to_world_message(scene, 0); }),
                       "cells has 18 values"));
}

TEST(Convert, StepArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_message(records.step(12, 9), 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.episode_id, 12);
  EXPECT_EQ(message.env_index, 3);
  EXPECT_EQ(message.step, 9);
  EXPECT_TRUE(std::ranges::equal(message.image, records.image));
  EXPECT_EQ(message.direction, 2);
  EXPECT_EQ(message.agent_x, 4);
  EXPECT_EQ(message.agent_y, 5);
  EXPECT_EQ(message.action, 6);
  EXPECT_EQ(message.value, 0.75f);
  EXPECT_EQ(message.entropy, 0.25f);
  EXPECT_EQ(message.reward, 0.9f);
  EXPECT_TRUE(message.terminated);
  EXPECT_FALSE(message.truncated);
  EXPECT_TRUE(std::ranges::equal(message.logits, records.logits));
  EXPECT_EQ(message.word_weights, records.weights);
  EXPECT_EQ(message.word_mask, records.mask);
  EXPECT_TRUE(std::ranges::equal(message.attention_map, records.map));
  ASSERT_EQ(message.word_attention.size(), 5u);
  EXPECT_EQ(message.word_attention[4][4], 0.52f);
  for (const auto& row : message.word_attention) {
    EXPECT_NEAR(std::accumulate(row.begin(), row.end(), 0.0), 1, 1e-6);
  }
}

TEST(Convert, StepOfABaselineHasNoWords) {
  const ExampleRecords records;
  policy::StepRecord record = records.step(12);
  record.word_weights = record.word_mask = record.word_attention = record.attention_map = {};
  const auto message = through_lcm(to_message(record, 0));
  EXPECT_EQ(message.num_tokens, 0);
  EXPECT_TRUE(message.word_attention.empty());
  EXPECT_EQ(std::ranges::count(message.attention_map, 0.0f), grid::kViewCells);
}

TEST(Convert, EpisodeEndArrivesWhole) {
  const auto message = through_lcm(to_message(ExampleRecords().end(12), 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.episode_id, 12);
  EXPECT_EQ(message.env_index, 3);
  EXPECT_EQ(message.num_steps, 17);
  EXPECT_EQ(message.episode_return, 0.88);
  EXPECT_TRUE(message.success);
  EXPECT_FALSE(message.truncated);
}

TEST(Convert, MetricsArriveWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_message(records.update(), kOrigin, 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.run_id, "run 1");
  EXPECT_EQ(message.update, 7);
  EXPECT_EQ(message.frames, 8960);
  EXPECT_EQ(message.name, (std::vector<std::string>{"success_rate", "entropy"}));
  EXPECT_EQ(message.value, (std::vector<double>{0.97, 0.5}));
}

TEST(Convert, RefusesArraysThatDoNotFitTogether) {
  const ExampleRecords records;
  const auto refusal = [&](auto spoil) {
    policy::StepRecord record = records.step(12);
    spoil(record);
    return message_of<std::invalid_argument>([&] { to_message(record, 0); });
  };
  EXPECT_EQ(refusal([](auto& r) { r.word_mask = r.word_mask.first(4); }),
            "LCM message: word_mask has 4 values, expected 5");
  EXPECT_TRUE(contains(refusal([](auto& r) { r.word_attention = r.word_attention.first(244); }),
                       "word_attention has 244 values, expected 245"));
  EXPECT_TRUE(contains(refusal([](auto& r) { r.attention_map = r.attention_map.first(48); }),
                       "attention_map has 48 values, expected 49"));
  EXPECT_TRUE(contains(refusal([](auto& r) { r.attention_map = {}; }), "expected 49"));
  EXPECT_TRUE(contains(refusal([](auto& r) { r.agent_x = 40000; }), "agent_x is 40000"));
  EXPECT_TRUE(contains(refusal([](auto& r) { r.action = 128; }), "action is 128"));
}

TEST(Convert, PolicyRequestArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_message(records.request(), 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.client_id, 77);
  EXPECT_EQ(message.seq, -5);
  EXPECT_EQ(message.num_completion, 2);
  EXPECT_EQ(to_request(message), records.request());
}

TEST(Convert, PolicyReplyArrivesWhole) {
  const ExampleRecords records;
  const auto message = through_lcm(to_message(records.reply(), 1234567));
  EXPECT_EQ(message.utime, 1234567);
  EXPECT_EQ(message.client_id, 77);
  EXPECT_EQ(message.seq, -5);
  EXPECT_EQ(message.error, "none");
  EXPECT_EQ(message.action, 2);
  EXPECT_EQ(message.num_actions, 3);
  EXPECT_EQ(message.probabilities, (std::vector<float>{0.5f, 0.25f, 0.25f}));
  EXPECT_EQ(message.value, 0.75f);
  EXPECT_EQ(message.num_tokens, 5);
  EXPECT_EQ(message.tokens, (std::vector<std::string>{"pick", "up", "the", "blue", "key"}));
  EXPECT_EQ(message.word_weights, records.weights);
  EXPECT_EQ(message.word_mask, records.mask);
  EXPECT_EQ(message.attention_map[48], 0.5f);
  EXPECT_EQ(message.nowhere, 0.125f);
  policy::Reply torn = records.reply();
  torn.word_mask.pop_back();
  EXPECT_THROW(to_message(torn, 1), std::invalid_argument);
  torn.word_mask.clear();
  torn.word_weights.clear();
  EXPECT_EQ(to_message(torn, 1).num_tokens, 0);  // without attention
}

}  // namespace
}  // namespace wordgaze::lcm_io
