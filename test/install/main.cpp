// A user's first program: turn around in a room, and see that what the library links comes along.
#include <array>
#include <cstdint>
#include <cstdio>

#include <wordgaze/core/setting.hpp>
#include <wordgaze/env/environment.hpp>
#include <wordgaze/io/config_file.hpp>
#if WITH_LCM
#include <lcm/lcm-cpp.hpp>
#include <wordgaze/step_t.hpp>
#endif

struct Plan {
  int turns = 1;
  static constexpr auto settings() {
    return std::tuple{wordgaze::Setting{"turns", &Plan::turns, "quarter turns to the left", 1, 8}};
  }
};

int main() {
  const Plan plan = wordgaze::io::parse_config<Plan>("turns = 4", "main.cpp");

  wordgaze::env::Environment room("BabyAI-GoToRedBallGrey-v0");
  room.reset(1);
  std::array<std::uint8_t, wordgaze::grid::kImageBytes> before{}, after{};
  room.observe(before);
  for (int turn = 0; turn < plan.turns; ++turn) room.step(wordgaze::grid::Action::left);
  room.observe(after);
  std::printf("%s: %d steps\n", room.mission().c_str(), room.step_count());
  if (room.step_count() != 4 || before != after) return 1;

#if WITH_LCM
  lcm::LCM bus("memq://");
  wordgaze::step_t message{};
  if (!bus.good() || bus.publish("WORDGAZE_STEP", &message) != 0) return 1;
#endif
  return 0;
}
