#include "wordgaze/lcm/decode.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "lcm/example_records.hpp"
#include "support/messages.hpp"
#include "wordgaze/lcm/convert.hpp"

namespace wordgaze::lcm_io {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Examples {
  Examples() {
    const ExampleRecords records;
    const Origin origin{"run 1", "a.safetensors"};
    begin = encode(to_message(records.begin(1), origin, 2));
    world = encode(to_world_message(records.scene(1), 2));
    progress = encode(to_progress_message(records.scene(1), 2));
    step = encode(to_message(records.step(1), 2));
    end = encode(to_message(records.end(1), 2));
    metrics = encode(to_message(records.update(), origin, 2));
    request = encode(to_message(records.request(), 2));
    reply = encode(to_message(records.reply(), 2));
  }
  Bytes begin, world, progress, step, end, metrics, request, reply;
};

/// Where the 4 bytes of a big-endian number stand in a message.
std::size_t position(const Bytes& bytes, std::uint8_t number, std::size_t from) {
  for (std::size_t i = from; i + 4 <= bytes.size(); ++i) {
    if (bytes[i] == 0 && bytes[i + 1] == 0 && bytes[i + 2] == 0 && bytes[i + 3] == number) return i;
  }
  ADD_FAILURE() << "no " << int{number};
  return 0;
}

Bytes with_number(Bytes bytes, std::size_t at, std::uint32_t number) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
  }
  return bytes;
}

template <class Message>
std::string refusal(const Bytes& bytes) {
  return message_of<std::runtime_error>([&] { decode<Message>(bytes); });
}

template <class Message>
void expect_all_truncations_refused(const Bytes& bytes) {
  EXPECT_EQ(encode(decode<Message>(bytes)), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(decode<Message>(std::span(bytes).first(size)), std::runtime_error) << size;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_TRUE(contains(refusal<Message>(longer), "bytes behind its end"));
}

TEST(Decode, GivesBackEachTypeAndRefusesItTruncated) {
  const Examples examples;
  expect_all_truncations_refused<episode_begin_t>(examples.begin);
  expect_all_truncations_refused<world_t>(examples.world);
  expect_all_truncations_refused<progress_t>(examples.progress);
  expect_all_truncations_refused<step_t>(examples.step);
  expect_all_truncations_refused<episode_end_t>(examples.end);
  expect_all_truncations_refused<metrics_t>(examples.metrics);
  expect_all_truncations_refused<policy_request_t>(examples.request);
  expect_all_truncations_refused<policy_reply_t>(examples.reply);
}

TEST(Decode, RefusesAnotherType) {
  const Examples examples;
  EXPECT_EQ(refusal<step_t>(examples.metrics), "not a valid step_t: its fingerprint is another");
  EXPECT_EQ(refusal<metrics_t>({}), "not a valid metrics_t: it is truncated");
}

// The counts that crash what lcm-gen writes: negative, far too large, and a length beyond 2 GiB.
TEST(Decode, RefusesHostileCounts) {
  const Examples examples;
  const std::size_t logits = position(examples.step, 7, 8 + 24 + 152 + 15);
  const std::size_t words = logits + 4 + 7 * 4;
  ASSERT_EQ(examples.step[words + 3], 5);
  for (const std::uint32_t count : {0xFFFFFFFFu, 0x20000000u, 0x80000000u, 0x7FFFFFFFu, 8u, 6u}) {
    EXPECT_THROW(decode<step_t>(with_number(examples.step, logits, count)), std::runtime_error);
    EXPECT_THROW(decode<step_t>(with_number(examples.step, words, count)), std::runtime_error);
  }
  const std::size_t cells = 8 + 24 + 4, sub_tasks = 8 + 24;
  ASSERT_EQ(examples.world[cells + 3], 18);
  ASSERT_EQ(examples.progress[sub_tasks + 3], 2);
  for (const std::uint32_t count : {0xFFFFFFFFu, 0x20000000u, 0x80000000u, 0x7FFFFFFFu, 17u, 3u}) {
    EXPECT_THROW(decode<world_t>(with_number(examples.world, cells, count)), std::runtime_error);
    EXPECT_THROW(decode<progress_t>(with_number(examples.progress, sub_tasks, count)),
                 std::runtime_error);
  }
  const std::size_t env_id = 8 + 8 + 8 + 4;
  for (const std::uint32_t length : {0u, 0xFFFFFFFFu, 0x80000000u, 0x7FFFFFFFu, 23u, 21u}) {
    EXPECT_THROW(decode<episode_begin_t>(with_number(examples.begin, env_id, length)),
                 std::runtime_error);
  }
  const std::size_t mission = 8 + 3 * 8 + 1, completions = examples.request.size() - 2 - 4;
  ASSERT_EQ(examples.request[completions + 3], 2);
  for (const std::uint32_t count : {0xFFFFFFFEu, 0xFFFFFFFFu, 0x80000000u, 0x20000000u, 0u, 3u}) {
    EXPECT_THROW(decode<policy_request_t>(with_number(examples.request, mission, count)),
                 std::runtime_error);
    EXPECT_THROW(decode<policy_request_t>(with_number(examples.request, completions, count)),
                 std::runtime_error);
  }
}

TEST(Decode, TakesMinusOneCompletionsForNone) {
  Bytes bytes = Examples().request;
  bytes.resize(bytes.size() - 2);
  const Bytes none = with_number(bytes, bytes.size() - 4, 0);
  EXPECT_EQ(encode(decode<policy_request_t>(with_number(bytes, bytes.size() - 4, 0xFFFFFFFFu))),
            none);
  EXPECT_TRUE(contains(refusal<policy_request_t>(with_number(bytes, bytes.size() - 4, 0xFFFFFFFEu)),
                       "a count is negative"));
}

TEST(Decode, SurvivesRandomDamage) {
  const Examples examples;
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes = round % 2 == 0 ? examples.begin : examples.metrics;
    for (int change = 0; change < 3; ++change) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      round % 2 == 0 ? (void)decode<episode_begin_t>(bytes) : (void)decode<metrics_t>(bytes);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace wordgaze::lcm_io
