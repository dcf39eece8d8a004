// A level of one's own as a text map, and a reward of one's own: each step costs, and the end is
// worth one.
#include <cstdio>

#include <wordgaze/babyai/level_text.hpp>
#include <wordgaze/env/environment.hpp>

using namespace wordgaze;

int main() {
  babyai::LevelSpec level = babyai::level_of({.id = "Own-Gap-v0",
                                              .map = R"(
#######
#>....#
###.###
#....G#
#######
)",
                                              .max_steps = 50});
  level.judge = [](const babyai::Moment& moment) {
    const bool there = moment.rule.terminated;
    return babyai::Verdict{.reward = there ? 1.0 : -0.01, .terminated = there};
  };
  babyai::register_level(level);

  env::Environment room("Own-Gap-v0");
  room.reset(1);
  using enum grid::Action;
  double sum = 0;
  bool ended = false;
  for (const auto action : {forward, forward, right, forward, forward, left, forward, forward}) {
    const auto step = room.step(action);
    sum += step.reward;
    ended = step.terminated;
  }
  std::printf("'%s': %.2f\n", room.mission().c_str(), sum);
  return ended && sum > 0.9 && sum < 0.95 ? 0 : 1;
}
