// A robot: one header, a mission in words, a view. Without weights there is nothing to load, and it
// says so.
#include <cstdio>
#include <stdexcept>
#include <string>

#include <wordgaze/policy/robot_policy.hpp>

int main(int argc, char** argv) {
  using namespace wordgaze;
  try {
    policy::RobotPolicy("none.safetensors");
    return 1;
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).find("none.safetensors") == std::string::npos) return 1;
  }
  if (argc < 2) return 1;
  policy::RobotPolicy policy(argv[1]);
  policy.begin("go to the red ball");
  auto view = policy::View::floor();
  view.put(3, 2, {grid::Type::ball, grid::Color::red});
  const policy::Act act = policy.act(view);
  std::printf("action %d, gaze on the ball %.2f\n", static_cast<int>(act.action),
              static_cast<double>(act.gaze.at(3, 2)));
  return act.action == grid::Action::forward && act.gaze.at(3, 2) > 0.5f ? 0 : 1;
}
