#include "wordgaze/training/curriculum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <set>

namespace wordgaze::training {
namespace {

Curriculum half_done(double share) {
  return Curriculum({.pickup_first = false,
                     .balance = false,
                     .half_done_start = share,
                     .half_done_end = share,
                     .stretch = 0,
                     .huddle = 0});
}

/// That of the parts; `any` of one.
babyai::Order order_of(const babyai::Instruction& instruction) {
  return *std::ranges::max_element(instruction.order);
}

/// The clauses marked at the starts of 200 episodes, as lists of 0/1.
std::set<std::vector<int>> starts(const char* id, babyai::Order order) {
  const Curriculum curriculum = half_done(1);
  env::Environment environment(id);
  core::Rng rng(1);
  std::set<std::vector<int>> seen;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    environment.reset(seed);
    if (order_of(environment.instruction()) != order) continue;
    EXPECT_TRUE(curriculum.prepare(environment, rng).helped);
    const auto c = environment.completion();
    seen.emplace(c.begin(), c.end());
  }
  return seen;
}

TEST(Curriculum, HalfDoneStartsMarkWhatComesFirst) {
  using Starts = std::set<std::vector<int>>;
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::before), (Starts{{1, 0}}));
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::after), (Starts{{0, 1}}));
  EXPECT_EQ(starts("Wordgaze-Two-N8-K4-v0", babyai::Order::any), (Starts{{1, 0}, {0, 1}}));
}

TEST(Curriculum, HalfDoneStartsLeaveFromOneClauseToAllButOne) {
  using Starts = std::set<std::vector<int>>;
  EXPECT_EQ(starts("Wordgaze-Four-N8-K4-v0", babyai::Order::before),
            (Starts{{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}, {1, 1, 0, 1}}));
}

TEST(Curriculum, HalfDoneStartsOfPutNextHaveTheObjectInHand) {
  const Curriculum curriculum = half_done(1);
  env::Environment environment("BabyAI-PutNextLocal-v0");
  core::Rng rng(1);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    environment.reset(seed);
    EXPECT_TRUE(curriculum.prepare(environment, rng).helped);
    EXPECT_EQ(grid::only(environment.world().carried), environment.meaning().object[0]);
  }
}

TEST(Curriculum, AFullHandTakesNothingMore) {
  const Curriculum curriculum = half_done(1);
  env::Environment environment("BabyAI-PutNextS5N2Carrying-v0");
  core::Rng rng(1);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    environment.reset(seed);
    const auto carried = environment.world().carried;
    EXPECT_FALSE(curriculum.prepare(environment, rng).helped);
    EXPECT_EQ(environment.world().carried, carried);
  }
}

/// All that can be switched on, for every level there is.
TEST(Curriculum, PreparesEveryLevel) {
  for (const double half_done_start : {0.0, 1.0}) {
    for (const double partial : {0.0, 0.5}) {
      const Curriculum curriculum({.pickup_first = false,
                                   .half_done_start = half_done_start,
                                   .half_done_end = half_done_start,
                                   .single_clause = 0.3,
                                   .stretch = 0.5,
                                   .huddle = 0.3,
                                   .partial = partial});
      for (const std::string& id : babyai::level_ids()) {
        env::Environment environment(id);
        core::Rng rng(1);
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
          environment.reset(seed);
          EXPECT_NO_THROW(curriculum.prepare(environment, rng)) << id << ' ' << seed;
          EXPECT_NO_THROW(environment.step(grid::Action::forward)) << id << ' ' << seed;
        }
      }
    }
  }
}

TEST(Curriculum, PutsTheFirstThatCanBeCarriedInTheHand) {
  // Objects described by their color alone may be doors.
  const Curriculum curriculum({.pickup_first = false,
                               .balance = false,
                               .half_done_start = 1,
                               .half_done_end = 1,
                               .stretch = 0,
                               .huddle = 0,
                               .partial = 1});
  env::Environment environment("BabyAI-PutNextLocal-v0");
  core::Rng rng(1);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    environment.reset(seed);
    EXPECT_TRUE(curriculum.prepare(environment, rng).helped);
    const auto carried = environment.world().carried;
    ASSERT_NE(carried, grid::kNothing);
    EXPECT_NE(environment.meaning().object[0] & grid::only(carried), 0u);
  }
}

TEST(Curriculum, LeavesTheEpisodesAloneThatItIsNotToHelp) {
  const Curriculum curriculum = half_done(0);
  env::Environment environment("Wordgaze-Two-N8-K4-v0");
  environment.reset(1);
  const auto instruction = environment.instruction();
  core::Rng rng(1);
  EXPECT_FALSE(curriculum.prepare(environment, rng).helped);
  EXPECT_EQ(environment.instruction(), instruction);
  EXPECT_EQ(std::ranges::count(environment.completion(), 1), 0);
}

CurriculumConfig only(double stretch, double huddle) {
  CurriculumConfig c;
  c.pickup_first = c.balance = false;
  c.stretch = stretch;
  c.huddle = huddle;
  return c;
}

/// How many of the three other objects lie in the eight cells around the target.
int neighbors_of_target(const env::Environment& environment) {
  const auto& world = environment.world();
  const auto target = std::countr_zero(environment.meaning().object[0]);
  const auto center = world.objects[static_cast<std::size_t>(target)].position;
  int count = -1;  // the target itself
  for (std::size_t id = grid::kWall + 1; id < world.objects.size(); ++id) {
    const auto p = world.objects[id].position;
    count += std::abs(p.x - center.x) <= 1 && std::abs(p.y - center.y) <= 1;
  }
  return count;
}

TEST(Curriculum, HuddlesTheOtherObjectsAroundTheTarget) {
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  const Curriculum curriculum(only(0, 1));
  core::Rng rng(1);
  int before = 0, after = 0;
  for (int seed = 0; seed < 100; ++seed) {
    environment.reset(seed);
    const auto objects = environment.world().objects.size();
    before += neighbors_of_target(environment);
    EXPECT_TRUE(curriculum.prepare(environment, rng).helped);
    after += neighbors_of_target(environment);
    EXPECT_EQ(environment.world().objects.size(), objects);
  }
  EXPECT_LT(before, 100);
  EXPECT_GT(after, 170);
}

TEST(Curriculum, NeverLocksATargetUp) {
  // Of nine cells five are taken: a careless huddle would wall the target or the agent in.
  env::Environment environment("Wordgaze-One-N5-K4-v0");
  const Curriculum curriculum(only(0, 1));
  core::Rng rng(1);
  for (int seed = 0; seed < 200; ++seed) {
    environment.reset(seed);
    curriculum.prepare(environment, rng);
    const auto& world = environment.world();
    const auto target = std::countr_zero(environment.meaning().object[0]);
    const auto center = world.objects[static_cast<std::size_t>(target)].position;
    bool open = false;
    for (const auto d : {grid::Direction::right, grid::Direction::down, grid::Direction::left,
                         grid::Direction::up}) {
      const auto p = center + grid::forward(d);
      open = open || world.grid[p] == grid::kNothing || p == world.agent;
    }
    EXPECT_TRUE(open) << "seed " << seed;
  }
}

TEST(Curriculum, StretchesAShareOfTheEpisodes) {
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  const Curriculum curriculum(only(0.5, 0));
  core::Rng rng(1);
  int helped = 0;
  for (int seed = 0; seed < 400; ++seed) {
    environment.reset(seed);
    const auto prepared = curriculum.prepare(environment, rng);
    EXPECT_TRUE(prepared.helped || prepared.stretch == Stretch{});
    helped += prepared.helped;
  }
  EXPECT_NEAR(helped, 200, 40);
}

TEST(Curriculum, ChangesNoViewAndNoWorldWhilePickupComesFirst) {
  CurriculumConfig config = only(1, 1);
  config.pickup_first = true;
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  core::Rng rng(1);
  environment.reset(1);
  EXPECT_FALSE(Curriculum(config).prepare(environment, rng).helped);
}

TEST(Curriculum, NamesNothingThatIsHeldOut) {
  CurriculumConfig config = only(0, 0);
  config.held_out = "red ball,  blue key , grey box";
  const Curriculum curriculum(config);
  for (const char* id : {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0"}) {
    env::Environment environment(id);
    core::Rng rng(1);
    int redrawn = 0;
    std::set<std::string> named;
    for (int seed = 0; seed < 400; ++seed) {
      environment.reset(seed);
      const auto mission = environment.mission();
      EXPECT_FALSE(curriculum.prepare(environment, rng).helped);
      redrawn += environment.mission() != mission;
      for (const char* kind : {"red ball", "blue key", "grey box", "blue ball", "red key"}) {
        if (environment.mission().find(kind) != std::string::npos) named.insert(kind);
      }
    }
    EXPECT_EQ(named, (std::set<std::string>{"blue ball", "red key"})) << id;
    EXPECT_NEAR(redrawn, 400 * environment.instruction().clauses() / 6, 40) << id;
  }
}

TEST(Curriculum, PartialMissionsNameSomeObjectByOneWord) {
  CurriculumConfig config = only(0, 0);
  config.partial = 1;
  config.held_out = "red ball, blue key, grey box";
  env::Environment environment("Wordgaze-One-N8-K4-v0");
  core::Rng rng(1);
  int types = 0, held_out = 0;
  for (int seed = 0; seed < 200; ++seed) {
    environment.reset(seed);
    EXPECT_TRUE(Curriculum(config).prepare(environment, rng).helped);
    const auto& meant = environment.instruction().clause[0].object;
    EXPECT_NE(meant.type.has_value(), meant.color.has_value());
    types += meant.type.has_value();
    const auto& target = environment.world().object(
        static_cast<grid::ObjectId>(std::countr_zero(environment.meaning().object[0])));
    held_out += target.type == grid::Type::ball && target.color == grid::Color::red;
  }
  EXPECT_NEAR(types, 100, 30);
  EXPECT_GT(held_out, 0);  // never named as what they are, but they are things like others
}

TEST(Curriculum, GivesUpWhereEverythingIsHeldOut) {
  CurriculumConfig config = only(0, 0);
  config.held_out = "red ball";
  env::Environment environment("BabyAI-GoToRedBall-v0");
  environment.reset(1);
  core::Rng rng(1);
  EXPECT_THROW(Curriculum(config).prepare(environment, rng), std::runtime_error);
}

TEST(HeldOut, RefusesWhatIsNoKindOfObject) {
  for (const char* list :
       {"ball", "red", "red door", "pink ball", "red ball blue key", "red ball,, blue key",
        "red ball on your left", "red ball and go to the box"}) {
    EXPECT_THROW(HeldOut{list}, std::invalid_argument) << list;
  }
  EXPECT_TRUE(HeldOut("").empty());
  EXPECT_FALSE(HeldOut("red ball,").empty());
}

}  // namespace
}  // namespace wordgaze::training
