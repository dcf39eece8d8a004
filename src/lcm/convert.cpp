#include "wordgaze/lcm/convert.hpp"

#include <algorithm>
#include <utility>

#include "wordgaze/core/require.hpp"

namespace wordgaze::lcm_io {
namespace {

template <class To>
To narrowed(std::string_view field, std::int64_t value) {
  require(std::in_range<To>(value), "LCM message: {} is {}, too large for its field", field, value);
  return static_cast<To>(value);
}

void require_size(std::string_view field, std::size_t size, std::size_t expected) {
  require(size == expected, "LCM message: {} has {} values, expected {}", field, size, expected);
}

}  // namespace

episode_begin_t to_message(const policy::EpisodeBegin& record, const Origin& origin,
                           std::int64_t utime) {
  episode_begin_t message{};
  message.utime = utime;
  message.episode_id = record.episode;
  message.env_index = record.lane;
  message.env_id = record.env_id;
  message.seed = static_cast<std::int64_t>(record.seed);
  message.mission = record.mission;
  for (const babyai::WordId id : record.sentence) {
    message.tokens.emplace_back(babyai::word(id));
    message.token_ids.push_back(id);
  }
  message.num_tokens = record.sentence.length;
  message.max_steps = record.max_steps;
  message.run_id = origin.run_id;
  message.checkpoint = origin.checkpoint;
  return message;
}

world_t to_world_message(const policy::SceneRecord& record, std::int64_t utime) {
  require_size("cells", record.cells.size(),
               std::size_t{3} * static_cast<std::size_t>(record.width) *
                   static_cast<std::size_t>(record.height));
  world_t message{};
  message.utime = utime;
  message.episode_id = record.episode;
  message.env_index = record.lane;
  message.step = record.step;
  message.width = narrowed<std::int16_t>("width", record.width);
  message.height = narrowed<std::int16_t>("height", record.height);
  message.num_bytes = narrowed<std::int32_t>("num_bytes", std::ssize(record.cells));
  message.cells.assign(record.cells.begin(), record.cells.end());
  message.agent_x = narrowed<std::int16_t>("agent_x", record.agent_x);
  message.agent_y = narrowed<std::int16_t>("agent_y", record.agent_y);
  message.direction = narrowed<std::int8_t>("direction", record.direction);
  std::ranges::copy(record.carried, message.carried);
  return message;
}

progress_t to_progress_message(const policy::SceneRecord& record, std::int64_t utime) {
  require_size("enabled", record.enabled.size(), record.completion.size());
  progress_t message{};
  message.utime = utime;
  message.episode_id = record.episode;
  message.env_index = record.lane;
  message.step = record.step;
  message.num_sub_tasks = narrowed<std::int32_t>("num_sub_tasks", std::ssize(record.completion));
  message.completed.assign(record.completion.begin(), record.completion.end());
  message.enabled.assign(record.enabled.begin(), record.enabled.end());
  message.num_tokens = narrowed<std::int32_t>("num_tokens", std::ssize(record.sub_task_of));
  message.sub_task_of.assign(record.sub_task_of.begin(), record.sub_task_of.end());
  message.num_targets = narrowed<std::int32_t>("num_targets", std::ssize(record.targets));
  for (const grid::Position cell : record.targets) {
    message.target_x.push_back(narrowed<std::int16_t>("target_x", cell.x));
    message.target_y.push_back(narrowed<std::int16_t>("target_y", cell.y));
  }
  return message;
}

step_t to_message(const policy::StepRecord& record, std::int64_t utime) {
  const std::size_t words = record.word_weights.size();
  require_size("word_mask", record.word_mask.size(), words);
  require_size("word_attention", record.word_attention.size(), words * grid::kViewCells);
  if (words > 0 || !record.attention_map.empty()) {
    require_size("attention_map", record.attention_map.size(), grid::kViewCells);
  }

  step_t message{};
  message.utime = utime;
  message.episode_id = record.episode;
  message.env_index = record.lane;
  message.step = record.step;
  static_assert(sizeof(message.image) == grid::kImageBytes);
  std::ranges::copy(record.image, message.image);
  message.direction = narrowed<std::int8_t>("direction", record.direction);
  message.agent_x = narrowed<std::int16_t>("agent_x", record.agent_x);
  message.agent_y = narrowed<std::int16_t>("agent_y", record.agent_y);
  message.action = narrowed<std::int8_t>("action", record.action);
  message.value = record.value;
  message.entropy = record.entropy;
  message.reward = record.reward;
  message.terminated = record.terminated;
  message.truncated = record.truncated;
  message.num_actions = narrowed<std::int32_t>("num_actions", std::ssize(record.logits));
  message.logits.assign(record.logits.begin(), record.logits.end());
  message.num_tokens = narrowed<std::int32_t>("num_tokens", std::ssize(record.word_weights));
  message.word_weights.assign(record.word_weights.begin(), record.word_weights.end());
  message.word_mask.assign(record.word_mask.begin(), record.word_mask.end());
  for (std::size_t word = 0; word < words; ++word) {
    const auto row = record.word_attention.subspan(word * grid::kViewCells, grid::kViewCells);
    message.word_attention.emplace_back(row.begin(), row.end());
  }
  std::ranges::copy(record.attention_map, message.attention_map);
  return message;
}

episode_end_t to_message(const policy::EpisodeEnd& record, std::int64_t utime) {
  return {.utime = utime,
          .episode_id = record.episode,
          .env_index = record.lane,
          .num_steps = record.steps,
          .episode_return = record.episode_return,
          .success = record.success,
          .truncated = record.truncated};
}

metrics_t to_message(const policy::UpdateRecord& record, const Origin& origin, std::int64_t utime) {
  metrics_t message{};
  message.utime = utime;
  message.run_id = origin.run_id;
  message.update = record.update;
  message.frames = record.frames;
  message.num_scalars = narrowed<std::int32_t>("num_scalars", std::ssize(record.scalars));
  for (const policy::Scalar& scalar : record.scalars) {
    message.name.emplace_back(scalar.name);
    message.value.push_back(scalar.value);
  }
  return message;
}

policy_request_t to_message(const policy::Request& request, std::int64_t utime) {
  policy_request_t message{};
  message.utime = utime;
  message.client_id = request.client;
  message.seq = request.sequence;
  message.reset = request.reset;
  message.mission = request.mission;
  std::ranges::copy(request.image, message.image);
  message.direction = narrowed<std::int8_t>("direction", request.direction);
  message.num_completion = narrowed<std::int32_t>("num_completion", std::ssize(request.completion));
  message.completion = request.completion;
  return message;
}

policy::Request to_request(const policy_request_t& message) {
  policy::Request request{.client = message.client_id,
                          .sequence = message.seq,
                          .reset = message.reset != 0,
                          .mission = message.mission,
                          .direction = message.direction,
                          .completion = message.completion};
  std::ranges::copy(message.image, request.image.begin());
  return request;
}

policy_reply_t to_message(const policy::Reply& reply, std::int64_t utime) {
  policy_reply_t message{};
  message.utime = utime;
  message.client_id = reply.client;
  message.seq = reply.sequence;
  message.error = reply.error;
  message.action = narrowed<std::int8_t>("action", reply.action);
  message.num_actions = narrowed<std::int32_t>("num_actions", std::ssize(reply.probabilities));
  message.probabilities = reply.probabilities;
  message.value = reply.value;
  const std::size_t words = reply.word_weights.size();
  require_size("word_mask", reply.word_mask.size(), words);
  if (words > 0) require_size("tokens", static_cast<std::size_t>(reply.sentence.length), words);
  message.num_tokens = narrowed<std::int32_t>("num_tokens", std::ssize(reply.word_weights));
  for (std::size_t i = 0; i < words; ++i) {
    message.tokens.emplace_back(babyai::word(reply.sentence.words[i]));
  }
  message.word_weights = reply.word_weights;
  message.word_mask = reply.word_mask;
  std::ranges::copy(reply.map, message.attention_map);
  message.nowhere = reply.nowhere;
  return message;
}

}  // namespace wordgaze::lcm_io
