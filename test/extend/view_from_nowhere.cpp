// An agent that acts on a view from nowhere: a robot's, a message's, or one drawn by hand. No
// environment, no simulator.
#include <array>
#include <cstdio>

#include <wordgaze/policy/network_policy.hpp>

using namespace wordgaze;

/// A floor without walls, and one ball; the agent stands at (3, 6) and looks toward y = 0.
policy::Observation view(int x, int y) {
  policy::Observation seen;
  for (int cell = 0; cell < grid::kViewCells; ++cell) seen.image[3 * cell] = 1;
  const int ball = grid::kViewSize * x + y;
  seen.image[3 * ball] = static_cast<std::uint8_t>(grid::Type::ball);
  seen.image[3 * ball + 1] = static_cast<std::uint8_t>(grid::Color::red);
  seen.sentence = babyai::sentence_of("go to the red ball");
  return seen;
}

int main(int, char** argv) {
  const auto trained = policy::TrainedAgent::load(argv[1]);
  policy::NetworkPolicy policy(trained);
  const auto act = [&](int x, int y) {
    policy.begin(0);
    policy.observe(0, view(x, y));
    return policy.decide(policy::Greedy{})[0].as_action();
  };
  const auto ahead = act(3, 2), left = act(0, 6), right = act(6, 6);
  policy::AttentionRecord record;
  policy.attention(0, record);
  std::printf("ahead: %d, left: %d, right: %d; the last map is brightest at the ball: %s\n",
              static_cast<int>(ahead), static_cast<int>(left), static_cast<int>(right),
              record.gaze.at(6 * 7 + 6) >= record.gaze.at(0) ? "yes" : "no");
  return ahead == grid::Action::forward && left == grid::Action::left &&
                 right == grid::Action::right
             ? 0
             : 1;
}
