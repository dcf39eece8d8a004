#pragma once
#include <cstdint>
#include <string>
#include <tuple>

#include "wordgaze/core/setting.hpp"
#include "wordgaze/model/config.hpp"
#include "wordgaze/model/task_mask.hpp"

/// Settings of training with their defaults: what learned best in configs/single.toml.
namespace wordgaze::training {

/// Recurrent proximal policy optimization (Schulman et al., 2017), docs/math.md (P1)-(P8).
struct PpoConfig {
  int lanes = 128;  ///< parallel environments
  int steps = 20;   ///< of a rollout, in each lane
  int chunk = 20;   ///< steps that gradients flow back through; divides `steps`
  int epochs = 4;
  int minibatches = 4;
  double learning_rate = 1e-3;
  double task_learning_rate = 2e-3;
  double learning_rate_end = 0.05;
  double discount = 0.99;
  double gae_lambda = 0.95;
  double clip = 0.2;
  double value_coefficient = 0.5;
  double entropy_start = 0.02;
  double entropy_end = 0.01;
  double entropy_frames = 1.5e6;
  double gradient_norm = 0.5;
  double advantage_floor = 0.2;
  double focus_start = 0.4;
  double focus_end = 0.75;
  double mask_coefficient = 1;
  model::MaskTruth mask_truth = model::MaskTruth::current;

  static constexpr auto settings() {
    using C = PpoConfig;
    return std::tuple{
        Setting{"lanes", &C::lanes, "parallel environments", 1, 65536},
        Setting{"steps", &C::steps, "steps of a rollout in each environment", 1, 4096},
        Setting{"chunk", &C::chunk, "steps of backpropagation through time; divides steps", 1,
                4096},
        Setting{"epochs", &C::epochs, "passes over a rollout", 1, 100},
        Setting{"minibatches", &C::minibatches, "parts of a pass; divide the sequences", 1, 4096},
        Setting{"learning_rate", &C::learning_rate, "at the start", 0, 1},
        Setting{"task_learning_rate", &C::task_learning_rate,
                "of the Task Attention Module, at the start", 0, 1},
        Setting{"learning_rate_end", &C::learning_rate_end,
                "share of both rates that is left at the end; they fall linearly", 0, 1},
        Setting{"discount", &C::discount, "gamma", 0, 1},
        Setting{"gae_lambda", &C::gae_lambda, "lambda of generalized advantage estimation", 0, 1},
        Setting{"clip", &C::clip, "epsilon of the clipped objective", 0, 10},
        Setting{"value_coefficient", &C::value_coefficient, "weight of the value loss", 0, 100},
        Setting{"entropy_start", &C::entropy_start, "weight of the entropy bonus at the start", 0,
                10},
        Setting{"entropy_end", &C::entropy_end, "and from entropy_frames on", 0, 10},
        Setting{"entropy_frames", &C::entropy_frames, "frames over which it falls", 0, 1e12},
        Setting{"gradient_norm", &C::gradient_norm, "largest norm of the gradient", 1e-6, 1e6},
        Setting{"advantage_floor", &C::advantage_floor,
                "least standard deviation by which advantages are divided", 0, 100},
        Setting{"focus_start", &C::focus_start,
                "share of the frames after which the product gaze begins to focus", 0, 1},
        Setting{"focus_end", &C::focus_end, "and has focused", 0, 1},
        Setting{"mask_coefficient", &C::mask_coefficient, "weight of L_TA", 0, 100},
        Setting{
            "mask_truth", &C::mask_truth,
            "words that the true mask silences: of completed sub-tasks; also of those not enabled; "
            "also of all but the current one"},
    };
  }
  bool operator==(const PpoConfig&) const = default;
};

/// What makes the start easier; each part can be switched off.
struct CurriculumConfig {
  bool pickup_first = true;
  double pickup_until = 0.2;
  bool balance = true;
  double half_done_start = 0;
  double half_done_end = 0;
  double half_done_frames = 6e5;
  double single_clause = 0;
  double stretch = 0.5;
  double huddle = 0.3;
  std::string held_out{};
  double partial = 0;

  static constexpr auto settings() {
    using C = CurriculumConfig;
    return std::tuple{
        Setting{"pickup_first", &C::pickup_first, "only pick-up missions at first"},
        Setting{"pickup_until", &C::pickup_until, "success that ends pickup_first", 0, 1},
        Setting{"balance", &C::balance, "then draw the verb that succeeds less more often"},
        Setting{
            "half_done_start", &C::half_done_start,
            "share of episodes that start with clauses done, or the object of a single put-next in "
            "hand; at the start",
            0, 1},
        Setting{"half_done_end", &C::half_done_end, "and from half_done_frames on", 0, 1},
        Setting{"half_done_frames", &C::half_done_frames, "frames over which it changes", 0, 1e12},
        Setting{"single_clause", &C::single_clause, "share of episodes cut down to one clause", 0,
                1},
        Setting{"stretch", &C::stretch,
                "share of episodes whose room seems larger, after pickup_first", 0, 1},
        Setting{"huddle", &C::huddle,
                "share of episodes with the other objects around the target, after pickup_first", 0,
                1},
        Setting{"held_out", &C::held_out,
                "kinds of objects that missions never name, as \"red ball, blue key\""},
        Setting{"partial", &C::partial,
                "share of episodes whose clauses name some object by its color or type alone", 0,
                1},
    };
  }
  bool operator==(const CurriculumConfig&) const = default;
};

struct TrainConfig {
  std::string env = "Wordgaze-One-N8-K4-v0";
  std::string level{};  ///< text of a level file; empty: a level that is known by its id
  std::int64_t frames = 2'000'000;
  std::int64_t seed = 1;
  int threads = 2;
  int probe_every = 20;
  int checkpoint_every = 50;
  int log_episodes = 100;
  model::Config model;
  PpoConfig ppo;
  CurriculumConfig curriculum;

  static constexpr auto settings() {
    using C = TrainConfig;
    return std::tuple{
        Setting{"env", &C::env, "id of the environment"},
        Setting{"level", &C::level,
                "text of a level of one's own, of that id (train --level FILE)"},
        Setting{"frames", &C::frames, "environment steps in all", 1, 1e15},
        Setting{"seed", &C::seed, "of weights, environments and actions", 0, 9e18},
        Setting{"threads", &C::threads, "workers; the same number repeats a run bit for bit", 1,
                256},
        Setting{"probe_every", &C::probe_every,
                "updates between two measurements of hit_12; 0: never", 0, 1e9},
        Setting{"checkpoint_every", &C::checkpoint_every, "updates between two checkpoints", 1,
                1e9},
        Setting{"log_episodes", &C::log_episodes, "every k-th episode goes into the LCM log", 1,
                1e9},
        Setting{"model", &C::model, "the network"},
        Setting{"ppo", &C::ppo, "the learner"},
        Setting{"curriculum", &C::curriculum, "what makes the start easier"},
    };
  }
  bool operator==(const TrainConfig&) const = default;
};

/// Throws std::invalid_argument where settings contradict each other.
void validate(const TrainConfig& config);

}  // namespace wordgaze::training
