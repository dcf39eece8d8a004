// Work for bench/count_instructions: steps of one environment with random actions, a view after
// each and a reset where an episode ends; equal on every machine. Prints the counts of the three.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "wordgaze/env/environment.hpp"

int main(int argc, char** argv) {
  using namespace wordgaze;
  const int steps = argc > 1 ? std::atoi(argv[1]) : 10'000;
  env::Environment environment("BabyAI-GoToLocal-v0");
  environment.reset(1);
  core::Rng rng(1);
  std::array<std::uint8_t, grid::kImageBytes> image{};
  int resets = 1;
  for (int k = 0; k < steps; ++k) {
    const auto action = static_cast<grid::Action>(rng.below(environment.num_actions()));
    const auto transition = environment.step(action);
    environment.observe(image);
    if (transition.terminated || transition.truncated) {
      environment.reset();
      ++resets;
    }
  }
  std::printf("%d %d %d\n", steps, steps, resets);
}
