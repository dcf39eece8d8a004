#include "wordgaze/policy/robot_policy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/policy/environment.hpp"

namespace wordgaze::policy {
namespace {

using grid::Action;
using grid::Color;
using grid::Type;
using Completion = RobotPolicy::Completion;

std::string model(const std::string& name) {
  return std::string(WORDGAZE_SOURCE_DIR "/models/") + name + ".safetensors";
}

View with(int x, int y, Cell cell) {
  View view = View::floor();
  view.put(x, y, cell);
  return view;
}
const View kBall = with(3, 2, {Type::ball, Color::red});

TEST(RobotPolicy, SaysWhatTheNetworkSays) {
  const auto trained = TrainedAgent::load(model("structured"));
  NetworkPolicy network(trained);
  RobotPolicy robot(model("structured"));
  env::Environment room("Wordgaze-Two-N8-K4-v0");
  for (int seed = 0; seed < 5; ++seed) {
    room.reset(seed);
    network.begin(0);
    robot.begin(room.sentence());
    for (int step = 0; step < 12; ++step) {
      const Observation observation = observe(room);
      for (int k = 0; k < robot.sub_tasks(); ++k) {
        robot.set_done(k, observation.completion[static_cast<std::size_t>(k)] != 0);
      }
      network.observe(0, observation);
      const Decision expected = network.decide(Greedy{})[0];
      const Act act = robot.act(observation.image);
      ASSERT_EQ(act.action, expected.as_action());
      EXPECT_EQ(act.value, expected.value);
      EXPECT_NEAR(std::log(act.probabilities[expected.action]), expected.log_prob, 1e-5);
      AttentionRecord attention;
      network.attention(0, attention);
      ASSERT_EQ(act.words.size(), attention.weights.size());
      EXPECT_TRUE(std::ranges::equal(act.gaze.cells, attention.gaze));
      EXPECT_EQ(act.nowhere, attention.nowhere);
      for (std::size_t i = 0; i < act.words.size(); ++i) {
        EXPECT_EQ(act.words[i].text, babyai::word(room.sentence().words[i]));
        EXPECT_EQ(act.words[i].weight, attention.weights[i]);
        EXPECT_EQ(act.words[i].mask, attention.mask[i]);
        EXPECT_EQ(act.words[i].map.at(3, 5), attention.maps[i * grid::kViewCells + 3 * 7 + 5]);
      }
      const auto transition = room.step(act.action);
      if (transition.terminated || transition.truncated) break;
    }
  }
}

/// The share of episodes that end well, where the robot is told nothing but mission and views.
double success(const std::string& weights, const std::string& level, RobotPolicy::Options options) {
  RobotPolicy robot(model(weights), options);
  env::Environment room(level);
  int successes = 0;
  constexpr int kEpisodes = 50;
  for (int seed = 0; seed < kEpisodes; ++seed) {
    room.reset(1'000'000 + seed);
    robot.begin(room.mission());
    for (bool ended = false; !ended;) {
      View view;
      room.observe(view.image);
      const auto transition = room.step(robot.act(view).action);
      ended = transition.terminated || transition.truncated;
      successes += transition.reward > 0;
    }
  }
  return static_cast<double>(successes) / kEpisodes;
}

TEST(RobotPolicy, FollowsAMissionOfTwoSubTasksByViewsAlone) {
  const std::string level = "Wordgaze-Two-N10-K4-v0";
  EXPECT_GE(success("structured", level, {.completion = Completion::declared}), 0.95);
  // Told of nothing, it declares the first sub-task again and again.
  EXPECT_LE(success("structured", level, {.completion = Completion::given}), 0.6);
}

TEST(RobotPolicy, FindsWhatItIsSentTo) {
  EXPECT_GE(success("single-attention", "Wordgaze-One-N8-K4-v0", {.greedy = false}), 0.95);
}

TEST(RobotPolicy, NumbersSubTasksAsTheSentence) {
  RobotPolicy robot(model("put-next"));
  robot.begin("put the red ball next to a blue box");
  EXPECT_EQ(robot.sub_tasks(), 2);
  robot.set_done(0);
  const Act act = robot.act(kBall);
  ASSERT_EQ(act.words.size(), 9u);
  EXPECT_EQ(act.words[3].text, "ball");
  EXPECT_EQ(act.words[3].sub_task, 0);
  EXPECT_EQ(act.words[8].text, "box");
  EXPECT_EQ(act.words[8].sub_task, 1);
  EXPECT_EQ(act.words[6].text, "a");
  EXPECT_EQ(std::vector<int>(robot.completion().begin(), robot.completion().end()),
            (std::vector<int>{1, 0}));
  robot.begin("go to the ball");
  EXPECT_EQ(robot.sub_tasks(), 1);
  EXPECT_EQ(robot.completion()[0], 0);
}

TEST(RobotPolicy, NumbersAreWhatTheyAreCalled) {
  RobotPolicy robot(model("single-attention"));
  robot.begin("go to the red ball");
  const Act act = robot.act(kBall);
  const auto sum = [](const auto& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0f);
  };
  EXPECT_NEAR(sum(act.probabilities), 1, 1e-5);
  EXPECT_NEAR(sum(act.gaze.cells) + act.nowhere, 1, 1e-4);
  float weights = 0;
  for (const auto& word : act.words) {
    weights += word.weight;
    EXPECT_GT(sum(word.map.cells), 0);
    EXPECT_LE(sum(word.map.cells), 1 + 1e-4f);
  }
  EXPECT_NEAR(weights, 1, 1e-4);
  EXPECT_GT(act.gaze.at(3, 2), 0.5f);
}

TEST(RobotPolicy, AnAgentWithoutAttentionLooksNowhere) {
  RobotPolicy robot(model("single-baseline"));
  robot.begin("go to the red ball");
  const Act act = robot.act(kBall);
  EXPECT_TRUE(act.words.empty());
  EXPECT_EQ(act.gaze.cells, ViewMap{}.cells);
}

TEST(RobotPolicy, BeginsWithAnEmptyMemory) {
  RobotPolicy robot(model("single-attention"));
  robot.begin("go to the red ball");
  const auto first = robot.act(kBall).probabilities;
  EXPECT_NE(robot.act(kBall).probabilities, first);
  robot.begin("go to the red ball");
  EXPECT_EQ(robot.act(kBall).probabilities, first);
}

TEST(RobotPolicy, RefusesWhatItCannotDoAndStaysAsItWas) {
  RobotPolicy robot(model("single-attention")), twin(model("single-attention"));
  EXPECT_THROW(robot.act(kBall), std::logic_error);
  EXPECT_THROW(robot.set_done(0), std::logic_error);
  EXPECT_THROW(robot.did(Action::left), std::logic_error);
  for (auto* each : {&robot, &twin}) each->begin("go to the red ball");
  for (const char* mission :
       {"", "fly to the red ball", "go to ball", "go to the ball and", "go to the red bal"}) {
    EXPECT_THROW(robot.begin(mission), std::invalid_argument) << mission;
  }
  View foreign = kBall;
  foreign.image[0] = 11;
  EXPECT_THROW(robot.act(foreign), std::invalid_argument);
  EXPECT_THROW(robot.set_done(1), std::invalid_argument);
  EXPECT_THROW(robot.set_done(-1), std::invalid_argument);
  EXPECT_EQ(robot.act(kBall).probabilities, twin.act(kBall).probabilities);
  EXPECT_THROW(RobotPolicy(model("none")), std::runtime_error);
  EXPECT_THROW(View{}.put(7, 0, {}), std::invalid_argument);
}

TEST(RobotPolicy, SaysWhatIsFollowedAndWhatIsGiven) {
  RobotPolicy robot(model("structured"), {.completion = Completion::true_now});
  EXPECT_THROW(robot.begin("go to the ball on your left"), std::invalid_argument);
  EXPECT_THROW(robot.begin(babyai::sentence_of("go to the ball")), std::invalid_argument);
  robot.begin("go to the red ball, then go to the blue key");
  EXPECT_THROW(robot.set_done(0), std::logic_error);
  const View near = with(3, 5, {Type::ball, Color::red});
  robot.act(kBall);
  EXPECT_EQ(robot.completion()[0], 0);
  robot.act(near);
  EXPECT_EQ(robot.completion()[0], 1);
}

TEST(RobotPolicy, KnowsThatTheRobotDidSomethingElse) {
  RobotPolicy robot(model("structured"), {.completion = Completion::declared});
  const View near = with(3, 5, {Type::ball, Color::red});
  for (const Action did : {Action::left, Action::done}) {
    robot.begin("go to the red ball, then go to the blue key");
    robot.act(near);
    robot.did(Action::right);
    robot.act(near);
    robot.did(did);
    robot.act(near);
    EXPECT_EQ(robot.completion()[0], did == Action::done ? 1 : 0);
  }
}

TEST(RobotPolicy, CanBeMoved) {
  RobotPolicy robot(model("single-attention")), other(model("single-baseline"));
  robot.begin("go to the red ball");
  other = std::move(robot);
  EXPECT_FALSE(other.act(kBall).words.empty());
}

}  // namespace
}  // namespace wordgaze::policy
