// A robot of one's own: a trained agent is told a mission and shown views; no environment.
#include <cstdio>
#include <utility>

#include <wordgaze/policy/robot_policy.hpp>

using namespace wordgaze;
using policy::View;

/// Stands for a robot with a camera: a red ball on an open floor, and how it lies.
struct Robot {
  int right = 2, ahead = 4;

  View look() const {
    View view = View::floor();
    view.put(View::kAgentX + right, View::kAgentY - ahead, {grid::Type::ball, grid::Color::red});
    return view;
  }
  void move(grid::Action action) {
    const bool blocked = right == 0 && ahead == 1;
    if (action == grid::Action::forward && !blocked) --ahead;
    if (action == grid::Action::left) right = std::exchange(ahead, -right);
    if (action == grid::Action::right) ahead = std::exchange(right, -ahead);
  }
};

int main(int, char** argv) {
  policy::RobotPolicy policy(argv[1], {.completion = policy::RobotPolicy::Completion::declared});
  policy.begin("go to the red ball");
  Robot robot;
  for (int step = 0; step < 20 && robot.ahead >= 0; ++step) {
    const policy::Act act = policy.act(robot.look());
    if (policy.completion()[0] == 1) return 0;  // the view before this one ended it
    std::printf(
        "action %d, %.2f of the gaze on the ball\n", static_cast<int>(act.action),
        static_cast<double>(act.gaze.at(View::kAgentX + robot.right, View::kAgentY - robot.ahead)));
    for (const auto& word : act.words) {
      if (step == 0) std::printf("  %.2f %s\n", static_cast<double>(word.weight), word.text.data());
    }
    robot.move(act.action);
  }
  return 1;
}
