#include "wordgaze/policy/follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/bot/policy.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::policy {
namespace {

using Counts = Follower::Counts;
using grid::Action;
using grid::Color;
using grid::Type;

View see(const env::Environment& environment) {
  View view;
  environment.observe(view.image);
  return view;
}

std::vector<int> numbers(const auto& completion, std::size_t size) {
  return {completion.begin(), completion.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// Where the simulator goes by what stood there, and a view by what is there: in front of a thing
/// that was just taken from where it stood.
bool remembers(const grid::World& world) {
  return world.carried != grid::kNothing && world.carried_from == world.front();
}

struct Agreement {
  int views = 0, agree = 0, halfway = 0, remembered = 0;
};

/// The follower beside the simulator's own c_t, over episodes of a policy.
Agreement follow(const std::string& id, const std::string& policy_name, int episodes) {
  env::Environment environment(id);
  const auto maker = bot::policy_maker(policy_name);
  const bool declared = environment.spec().done_mode == babyai::DoneMode::sequential;
  Agreement agreement;
  for (int seed = 0; seed < episodes; ++seed) {
    environment.reset(seed);
    const auto policy = maker(id, static_cast<std::uint64_t>(seed), 0);
    Follower follower(environment.instruction(),
                      declared ? Counts::when_declared : Counts::when_true);
    follower.see(see(environment), {});
    for (bool ended = false; !ended;) {
      const Action action = policy(environment);
      const bool remembered = remembers(environment.world());
      const auto transition = environment.step(action);
      ended = transition.terminated || transition.truncated;
      follower.see(see(environment), action);
      const auto progress = environment.progress();
      const auto truth = progress.completion();
      const bool same =
          numbers(follower.completion(), truth.size()) == numbers(truth, truth.size());
      if (!same && (remembered || remembers(environment.world()))) {
        ++agreement.remembered;
        break;  // from here on they speak of different things
      }
      const auto done = std::ranges::count(truth, 1);
      ++agreement.views;
      agreement.agree += same;
      agreement.halfway += done > 0 && done < static_cast<std::ptrdiff_t>(truth.size());
    }
  }
  return agreement;
}

class Following : public testing::TestWithParam<const char*> {};

TEST_P(Following, ViewsTellWhatTheSimulatorKnows) {
  for (const char* policy : {"bot", "random"}) {
    constexpr int kEpisodes = 200;
    const Agreement a = follow(GetParam(), policy, kEpisodes);
    EXPECT_GT(a.views, kEpisodes);
    EXPECT_EQ(a.agree, a.views) << policy;
    EXPECT_LE(a.remembered, kEpisodes / 10) << policy;
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Following,
                         testing::Values("Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0",
                                         "Wordgaze-Three-N8-K6-v0", "Wordgaze-Four-N8-K6-v0",
                                         "Wordgaze-Two-N8-K4-auto-v0", "BabyAI-PutNextLocal-v0",
                                         "BabyAI-GoToSeq-v0", "BabyAI-OpenTwoDoors-v0",
                                         "BabyAI-UnlockPickup-v0"));

std::vector<int> after(const char* mission, Counts counts,
                       const std::vector<std::pair<Action, View>>& story) {
  const auto instruction = babyai::parse_mission(mission);
  Follower follower(instruction, counts);
  follower.see(View::floor(), {});
  for (const auto& [action, view] : story) follower.see(view, action);
  return numbers(follower.completion(), 2);
}

View ahead(Cell cell) {
  View view = View::floor();
  view.put(View::kAgentX, View::kAgentY - 1, cell);
  return view;
}

TEST(Follower, CountsWhenTrueOrWhenDeclared) {
  const View key = ahead({Type::key, Color::blue}), floor = View::floor();
  const char* mission = "go to the blue key, then go to the red ball";
  using V = std::vector<int>;
  EXPECT_EQ(after(mission, Counts::when_true, {{Action::forward, key}}), (V{1, 0}));
  EXPECT_EQ(after(mission, Counts::when_declared, {{Action::forward, key}}), (V{0, 0}));
  EXPECT_EQ(after(mission, Counts::when_declared, {{Action::forward, key}, {Action::done, key}}),
            (V{1, 0}));
  EXPECT_EQ(after(mission, Counts::when_declared,
                  {{Action::forward, key}, {Action::left, floor}, {Action::done, floor}}),
            (V{0, 0}));
}

TEST(Follower, HasClausesInTheirTurn) {
  const View ball = ahead({Type::ball, Color::red});
  using V = std::vector<int>;
  EXPECT_EQ(after("go to the blue key, then go to the red ball", Counts::when_true,
                  {{Action::forward, ball}}),
            (V{0, 0}));
  EXPECT_EQ(after("go to the blue key after you go to the red ball", Counts::when_true,
                  {{Action::forward, ball}}),
            (V{0, 1}));
  EXPECT_EQ(after("go to the blue key and go to the red ball", Counts::when_true,
                  {{Action::forward, ball}}),
            (V{0, 1}));
}

TEST(Follower, RefusesPlacesThatNoLaterViewShows) {
  for (const char* mission :
       {"go to the ball on your left", "put a key next to the box behind you"}) {
    EXPECT_THROW(Follower(babyai::parse_mission(mission), Counts::when_true),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace wordgaze::policy
