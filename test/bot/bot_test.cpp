#include "wordgaze/bot/bot.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include "wordgaze/babyai/level.hpp"

namespace wordgaze::bot {
namespace {

using grid::Action;

constexpr std::string_view kLetters = "lrfpdtx";  // by the number of the action

// An episode of the reference's bot, written by scripts/golden/bot_episodes.py.
struct Episode {
  std::string id;
  std::uint64_t seed = 0;
  std::string outcome{};
  std::string actions{};  // a capital: done although the bot had said otherwise
};

std::vector<Episode> episodes() {
  std::ifstream in(WORDGAZE_TEST_DATA "/bot/episodes.txt");
  std::vector<Episode> all;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    Episode& episode = all.emplace_back();
    std::istringstream(line) >> episode.id >> episode.seed >> episode.outcome >> episode.actions;
  }
  return all;
}

// What becomes of the episode when our bot acts, and is meddled with where the reference's was.
// The letters of the actions are ours, capitals stay where we also say something else.
Episode replayed(const Episode& theirs) {
  Episode ours{.id = theirs.id, .seed = theirs.seed, .outcome = "cut"};
  env::Environment env(theirs.id);
  env.reset(theirs.seed);
  Bot bot(env);
  std::optional<Action> taken;
  while (ours.actions.size() <= theirs.actions.size()) {
    const std::size_t k = ours.actions.size();
    if (theirs.outcome == "cut" && k == theirs.actions.size()) break;
    taken = bot.next(env, taken);
    if (!taken || taken == Action::done) {
      ours.outcome = taken ? "finished" : "gave_up";
      break;
    }
    char letter = kLetters[static_cast<std::size_t>(*taken)];
    if (k < theirs.actions.size() && std::isupper(theirs.actions[k]) != 0) {
      const auto other = kLetters.find(static_cast<char>(std::tolower(theirs.actions[k])));
      if (taken != static_cast<Action>(other)) letter = theirs.actions[k];
      taken = static_cast<Action>(other);
    }
    ours.actions += letter;
    const env::Transition transition = env.step(*taken);
    if (transition.terminated || transition.truncated) {
      ours.outcome = !transition.terminated  ? "time_up"
                     : transition.reward > 0 ? "success"
                                             : "failure";
      break;
    }
  }
  return ours;
}

TEST(Bot, DoesWhatTheReferenceDoes) {
  for (const Episode& theirs : episodes()) {
    const Episode ours = replayed(theirs);
    EXPECT_EQ(ours.actions, theirs.actions) << theirs.id << ", seed " << theirs.seed;
    EXPECT_EQ(ours.outcome, theirs.outcome) << theirs.id << ", seed " << theirs.seed;
  }
}

TEST(Bot, IsComparedOnEveryLevelOfBabyAi) {
  std::set<std::string> compared;
  for (const Episode& episode : episodes()) compared.insert(episode.id);
  for (const std::string& id : babyai::level_ids()) {
    EXPECT_TRUE(compared.contains(id) || !id.starts_with("BabyAI-")) << id;
  }
}

TEST(Bot, IsComparedInAllItsWaysToEnd) {
  std::set<std::string> outcomes;
  for (const Episode& episode : episodes()) outcomes.insert(episode.outcome);
  for (const char* outcome : {"success", "failure", "time_up", "gave_up", "cut"}) {
    EXPECT_TRUE(outcomes.contains(outcome)) << outcome;
  }
}

TEST(Bot, GoesOnIdenticallyInACopy) {
  env::Environment env("BabyAI-MiniBossLevel-v0");
  env.reset(5);
  Bot bot(env);
  for (int n = 0; n < 10; ++n) env.step(bot.next(env).value());
  env::Environment other_env = env;
  Bot other_bot = bot;
  bool over = false;
  while (!over) {
    const auto action = bot.next(env), other_action = other_bot.next(other_env);
    ASSERT_TRUE(action.has_value());
    ASSERT_EQ(action, other_action);
    over = env.step(*action).terminated;
    EXPECT_EQ(other_env.step(*action).terminated, over);
  }
}

TEST(Bot, StaysSilentOnceItHasGivenUp) {
  env::Environment env("BabyAI-KeyInBox-v0");  // it does not know of keys in boxes
  env.reset(0);
  Bot bot(env);
  std::optional<Action> action;
  while ((action = bot.next(env))) env.step(*action);
  EXPECT_LT(env.step_count(), env.max_steps());
  EXPECT_EQ(bot.next(env), std::nullopt);
}

TEST(Bot, SolvesTasksOfOneRoom) {
  for (const char* id : {"Wordgaze-Two-N8-K4-auto-v0", "Wordgaze-Six-N8-K8-auto-v0",
                         "Wordgaze-Eight-N8-K8-auto-v0"}) {
    env::Environment env(id);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      env.reset(seed);
      Bot bot(env);
      env::Transition last;
      while (!last.terminated && !last.truncated) last = env.step(bot.next(env).value());
      EXPECT_GT(last.reward, 0) << id << ", seed " << seed << ": " << env.mission();
    }
  }
}

TEST(Bot, RefusesAnEnvironmentWithoutInstruction) {
  env::Environment env("MiniGrid-Empty-5x5-v0");
  env.reset(0);
  EXPECT_THROW(Bot{env}, std::invalid_argument);
}

}  // namespace
}  // namespace wordgaze::bot
