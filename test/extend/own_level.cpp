// An own level that trains: one ball of a color, one box of another, and a mission about either.
#include <cstdio>

#include <wordgaze/babyai/layout.hpp>
#include <wordgaze/training/trainer.hpp>

using namespace wordgaze;

/// Draws one world and what is asked for in it.
void ball_and_box(babyai::Layout& layout) {
  layout.place_agent();
  const auto ball = layout.add_object({0, 0}, grid::Type::ball, grid::Color::purple);
  const auto box = layout.add_object({0, 0}, grid::Type::box, grid::Color::green);
  layout.require_reachable();
  layout.ask(babyai::Verb::go_to, layout.describe(layout.rng.below(2) == 0 ? ball : box));
}

int main() {
  babyai::register_level({.id = "Own-BallAndBox-v0",
                          .generate = ball_and_box,
                          .room_size = 6,
                          .rows = 1,
                          .columns = 1,
                          .max_steps = 36});
  training::TrainConfig config;
  config.env = "Own-BallAndBox-v0";
  config.frames = 80'000;
  config.threads = 1;
  config.curriculum = {.pickup_first = false, .balance = false, .stretch = 0, .huddle = 0};
  training::Trainer trainer(config);
  training::Metrics metrics;
  while (!trainer.finished()) metrics = trainer.update();
  std::printf("success %.3f after %.0f frames\n", metrics.success_rate, metrics.frames);
  return metrics.success_rate > 0.9 ? 0 : 1;
}
