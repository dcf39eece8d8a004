#pragma once
#include <array>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "wordgaze/policy/observer.hpp"
#include "wordgaze/policy/server.hpp"

namespace wordgaze::lcm_io {

/// A mission and what an agent with attention might report about one step of it, with the buffers
/// that the records look at.
struct ExampleRecords {
  babyai::Sentence sentence = babyai::sentence_of("pick up the blue key");
  std::string mission = "pick up the blue key";
  std::array<std::uint8_t, grid::kImageBytes> image{};
  std::array<float, 7> logits{0.5f, -1, 2, 0, 0, 1e-3f, -30};
  std::vector<float> weights{0.1f, 0.1f, 0.2f, 0.3f, 0.3f};
  std::vector<float> mask{1, 1, 0.5f, 0, 1};
  std::vector<float> attention;
  std::vector<float> map = std::vector<float>(grid::kViewCells, 0.02f);
  std::array<std::uint8_t, 18> cells{2, 5, 0, 1, 0, 0, 2, 5, 0, 2, 5, 0, 5, 2, 0, 4, 1, 2};
  std::array<std::uint8_t, 2> completion{1, 0}, enabled{0, 1};
  std::array<grid::Position, 2> targets{grid::at(1, 1), grid::at(2, 1)};
  std::array<policy::Scalar, 2> scalars{{{"success_rate", 0.97}, {"entropy", 0.5}}};

  ExampleRecords() {
    std::iota(image.begin(), image.end(), std::uint8_t{0});
    for (int word = 0; word < 5; ++word) {
      for (int cell = 0; cell < grid::kViewCells; ++cell) {
        attention.push_back(cell == word ? 0.52f : 0.01f);
      }
    }
  }

  policy::EpisodeBegin begin(std::int64_t episode, int steps = 0) const {
    return {.episode = episode,
            .lane = 3,
            .env_id = "Wordgaze-One-N8-K4-v0",
            .seed = 18446744073709551615u,
            .sentence = sentence,
            .mission = mission,
            .max_steps = 128,
            .steps = steps};
  }
  policy::StepRecord step(std::int64_t episode, int number = 0) const {
    return {.episode = episode,
            .lane = 3,
            .step = number,
            .image = image,
            .direction = 2,
            .agent_x = 4,
            .agent_y = 5,
            .action = 6,
            .value = 0.75f,
            .entropy = 0.25f,
            .reward = 0.9f,
            .terminated = true,
            .truncated = false,
            .logits = logits,
            .word_weights = weights,
            .word_mask = mask,
            .word_attention = attention,
            .attention_map = map};
  }
  policy::SceneRecord scene(std::int64_t episode, int number = 0) const {
    return {.episode = episode,
            .lane = 3,
            .step = number,
            .width = 3,
            .height = 2,
            .cells = cells,
            .agent_x = 1,
            .agent_y = 0,
            .direction = 2,
            .carried = {5, 2, 0},
            .completion = completion,
            .enabled = enabled,
            .sub_task_of = std::span(sentence.sub_task_of).first(5),
            .targets = targets};
  }
  policy::EpisodeEnd end(std::int64_t episode) const {
    return {.episode = episode,
            .lane = 3,
            .steps = 17,
            .episode_return = 0.88,
            .success = true,
            .truncated = false};
  }
  policy::UpdateRecord update(std::int64_t number = 7) const {
    return {.update = number, .frames = 1280 * number, .scalars = scalars};
  }
  policy::Request request() const {
    return {.client = 77,
            .sequence = -5,
            .reset = true,
            .mission = mission,
            .image = image,
            .direction = 3,
            .completion = {1, 0}};
  }
  policy::Reply reply() const {
    policy::Reply reply{.client = 77,
                        .sequence = -5,
                        .error = "none",
                        .action = 2,
                        .probabilities = {0.5f, 0.25f, 0.25f},
                        .value = 0.75f,
                        .sentence = sentence,
                        .word_weights = weights,
                        .word_mask = mask,
                        .nowhere = 0.125f};
    reply.map[48] = 0.5f;
    return reply;
  }
};

}  // namespace wordgaze::lcm_io
