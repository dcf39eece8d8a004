#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "support/messages.hpp"
#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/layout.hpp"
#include "wordgaze/babyai/level_edit.hpp"
#include "wordgaze/babyai/level_text.hpp"
#include "wordgaze/babyai/minigrid_stages.hpp"
#include "wordgaze/babyai/stages.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/env/random_policy.hpp"

// Levels as a user writes them.
namespace wordgaze::env {
namespace {

using babyai::Layout;
using babyai::LevelSpec;
using babyai::Objects;
using babyai::Rule;
using grid::Action;
using grid::Color;
using grid::Type;

// Two rooms and a locked door; the key lies among distractors, a ball behind the door.
void fetch_through_door(Layout& layout) {
  const grid::ObjectId ball = layout.add_object({1, 0}, Type::ball);
  const grid::ObjectId door = layout.add_door({0, 0}, grid::Direction::right, {}, true);
  babyai::generators::add_key(layout, {0, 0}, door);
  layout.scatter_objects(grid::RoomIndex{0, 0});
  layout.place_agent(grid::RoomIndex{0, 0});
  layout.require_reachable();
  layout.ask(babyai::Verb::pickup, layout.describe(ball));
}

// A mission outside BabyAI's grammar, as MiniGrid's own levels have them.
void find_the_goal(Layout& layout) {
  babyai::generators::empty_grid(layout);
  babyai::generators::goal_in_corner(layout);
  layout.Builder::place_agent();
  babyai::generators::ask(layout, "go to the end of the room");
}

const LevelSpec& own_level() {
  static const LevelSpec level = [] {
    LevelSpec l{.id = "Own-FetchThroughDoor-v0",
                .generate = fetch_through_door,
                .room_size = 6,
                .rows = 1,
                .columns = 2,
                .parameters = Objects{.count = 2}};
    babyai::register_level(l);
    babyai::register_level({.id = "Own-FindTheGoal-v0",
                            .generate = find_the_goal,
                            .room_size = 6,
                            .rows = 1,
                            .columns = 1,
                            .max_steps = 60,
                            .rule = Rule::goal});
    return l;
  }();
  return level;
}

void expect_equal(const Environment& a, const Environment& b) {
  std::array<std::uint8_t, grid::kImageBytes> of_a, of_b;
  a.observe(of_a);
  b.observe(of_b);
  ASSERT_EQ(of_a, of_b);
  ASSERT_EQ(a.mission(), b.mission());
  ASSERT_EQ(a.world().agent, b.world().agent);
  ASSERT_EQ(a.rng().state(), b.rng().state());
}

struct OwnLevel : testing::Test {
  OwnLevel() { own_level(); }
};

TEST_F(OwnLevel, IsFoundByItsIdAndListedBehindTheBuiltInOnes) {
  const auto ids = babyai::level_ids();
  EXPECT_EQ(ids[babyai::built_in_levels().size()], own_level().id);
  EXPECT_EQ(babyai::find_level(own_level().id).generate, own_level().generate);
}

TEST_F(OwnLevel, PlaysEqualEpisodesFromEqualSeeds) {
  for (const char* id : {"Own-FetchThroughDoor-v0", "Own-FindTheGoal-v0"}) {
    Environment a(id), b(id), other(id);
    a.reset(7);
    b.reset(7);
    other.reset(8);
    expect_equal(a, b);
    EXPECT_NE(a.rng().state(), other.rng().state());
    RandomPolicy policy(id, 1);
    int ended = 0;
    for (int n = 0; n < 500; ++n) {
      const Action action = policy(a);
      const Transition t = a.step(action);
      b.step(action);
      expect_equal(a, b);
      if (!t.terminated && !t.truncated) continue;
      a.reset();
      b.reset();
      ++ended;
    }
    EXPECT_GT(ended, 0) << id;
  }
}

TEST_F(OwnLevel, SaysItsMissionInItsOwnWords) {
  Environment room("Own-FindTheGoal-v0");
  room.reset(1);
  EXPECT_EQ(room.mission(), "go to the end of the room");
  EXPECT_EQ(room.max_steps(), 60);
  Environment door("Own-FetchThroughDoor-v0");
  door.reset(1);
  EXPECT_EQ(door.mission().rfind("pick up ", 0), 0u);
  EXPECT_EQ(door.max_steps(), 2 * 36);
}

TEST_F(OwnLevel, ResumesFromItsSerializedState) {
  Environment env(own_level().id), other(own_level().id);
  env.reset(3);
  env.step(Action::forward);
  other.restore(env.serialize());
  for (const Action action : {Action::left, Action::forward, Action::pickup, Action::toggle}) {
    env.step(action);
    other.step(action);
    expect_equal(env, other);
  }
}

TEST_F(OwnLevel, MayBeEdited) {
  Environment env("Own-FetchThroughDoor-v0[room_size=8][objects=5]");
  env.reset(1);
  EXPECT_EQ(env.world().grid.width(), 15);
  EXPECT_EQ(env.world().objects.size(), 2u + 3 + 5);
}

TEST_F(OwnLevel, IsRefusedAnIdThatIsKnownOrNone) {
  const auto refused = [](const char* id) {
    LevelSpec level = own_level();
    level.id = id;
    return message_of<std::invalid_argument>([&] { babyai::register_level(level); });
  };
  EXPECT_TRUE(contains(refused("Own-FetchThroughDoor-v0"), "registered already"));
  EXPECT_TRUE(contains(refused("BabyAI-GoToLocal-v0"), "built-in"));
  EXPECT_TRUE(contains(refused("Wordgaze-Two-N12-K5-v0"), "built-in"));
  for (const char* id : {"", "Own Level", "Own,Level", "Own[objects=4]"}) {
    EXPECT_TRUE(contains(refused(id), "is no id")) << id;
  }
  EXPECT_EQ(babyai::level_ids().size(), babyai::built_in_levels().size() + 2);
}

TEST_F(OwnLevel, IsRefusedNumbersOutOfRange) {
  LevelSpec level = own_level();
  level.id = "Own-TooFull-v0";
  level.parameters = Objects{.count = 1000};
  EXPECT_THROW(babyai::register_level(level), std::invalid_argument);
  EXPECT_THROW(babyai::find_level(level.id), std::invalid_argument);
}

// Generators with a mistake; each must be told, and none may write out of bounds.
struct Mistake {
  const char* what;
  babyai::Generator generate;
  Rule rule;
};

const Mistake kMistakes[] = {
    {"no agent",
     [](Layout& l) {
       l.world.agent = grid::kNowhere;
       l.ask(babyai::Verb::go_to, {});
     },
     Rule::instruction},
    {"no instruction", [](Layout& l) { l.place_agent(); }, Rule::instruction},
    {"too many clauses",
     [](Layout& l) {
       l.place_agent();
       l.task.instruction.count = 200;
     },
     Rule::instruction},
    {"\"and\" of three",
     [](Layout& l) {
       l.place_agent();
       l.task.instruction.count = 3;
     },
     Rule::instruction},
    {"a room that is none",
     [](Layout& l) {
       l.place_agent(grid::RoomIndex{3, 0});
     },
     Rule::goal},
    {"a door to nowhere",
     [](Layout& l) {
       l.add_door({0, 0}, grid::Direction::up);
     },
     Rule::goal},
    {"a target that is none",
     [](Layout& l) {
       l.place_agent();
       l.task.target.object = 200;
     },
     Rule::fetch},
    {"an obstacle that is none", [](Layout& l) { l.place_agent(); }, Rule::dynamic_obstacles},
    {"an obstacle that stands nowhere",
     [](Layout& l) {
       l.place_agent();
       l.task.target.object = l.world.add(Type::ball, Color::blue);
     },
     Rule::dynamic_obstacles},
    {"carrying what is not there",
     [](Layout& l) {
       l.place_agent();
       l.task.start_carrying = l.world.add(Type::ball, Color::blue);
     },
     Rule::goal},
    {"too many objects",
     [](Layout& l) {
       for (;;) l.world.add(Type::ball, Color::blue);
     },
     Rule::goal},
    {"too many words",
     [](Layout& l) {
       for (;;) babyai::generators::say(l.task.sentence, "go");
     },
     Rule::goal},
    {"parameters of another family", [](Layout& l) { (void)l.parameters<babyai::Maze>().quarters; },
     Rule::goal},
    {"a choice of nothing", [](Layout& l) { l.pick_object({}); }, Rule::goal},
    {"one door more than walls",
     [](Layout& l) {
       for (;;) l.add_door({0, 0});
     },
     Rule::goal},
    {"more kinds than there are",
     [](Layout& l) {
       l.world.clear(40, 40);
       l.scatter(grid::RoomIndex{0, 0}, 19, true);
     },
     Rule::goal},
    {"a full grid",
     [](Layout& l) {
       l.world.clear(3, 3);
       l.world.grid.wall_rectangle({}, 3, 3);
       l.world.put(l.world.add(Type::ball, Color::blue), {1, 1});
       l.Builder::place_agent();
     },
     Rule::goal},
    {"a rectangle outside",
     [](Layout& l) {
       l.place(grid::kNothing, {90, 90}, 3, 3);
     },
     Rule::goal},
};

TEST(OwnGenerator, IsToldItsMistakes) {
  for (const Mistake& mistake : kMistakes) {
    Environment env(LevelSpec{.id = "Own-Mistake-v0",
                              .generate = mistake.generate,
                              .rows = 1,
                              .columns = 2,
                              .max_steps = 10,
                              .rule = mistake.rule,
                              .parameters = Objects{.count = 1}});
    EXPECT_THROW(env.reset(1), std::exception) << mistake.what;
    EXPECT_THROW(env.step(Action::left), std::logic_error) << mistake.what;
  }
}

// Reward and end as a function.

Environment judged(const char* id, babyai::Judge judge) {
  LevelSpec level = babyai::find_level(id);
  level.judge = std::move(judge);
  Environment environment(level);
  environment.reset(1);
  return environment;
}

TEST(Judge, SaysRewardAndEnd) {
  Environment room = judged("BabyAI-GoToLocal-v0", [](const babyai::Moment& moment) {
    const bool turned = moment.action == Action::left;
    return babyai::Verdict{.reward = turned ? 0.25 : -0.5,
                           .terminated = moment.world.step_count == 3};
  });
  const auto first = room.step(Action::left), second = room.step(Action::right),
             third = room.step(Action::left);
  EXPECT_EQ(first.reward, 0.25);
  EXPECT_FALSE(first.terminated);
  EXPECT_EQ(second.reward, -0.5);
  EXPECT_EQ(third.reward, 0.25);
  EXPECT_TRUE(third.terminated);
  EXPECT_FALSE(third.truncated);
}

TEST(Judge, MayGoByTheRuleAndStaysDeterministic) {
  const auto plus = [](const babyai::Moment& moment) {
    return babyai::Verdict{.reward = moment.rule.reward + 0.01,
                           .terminated = moment.rule.terminated};
  };
  for (const char* id :
       {"BabyAI-GoToLocal-v0", "MiniGrid-Dynamic-Obstacles-5x5-v0", "MiniGrid-DoorKey-5x5-v0"}) {
    Environment shaped = judged(id, plus), plain(id);
    plain.reset(1);
    core::Rng rng(7);
    for (int step = 0; step < 300; ++step) {
      const auto action = static_cast<Action>(rng.below(plain.num_actions()));
      const auto a = shaped.step(action), b = plain.step(action);
      ASSERT_EQ(a.reward, b.reward + 0.01);
      ASSERT_EQ(a.terminated, b.terminated);
      ASSERT_EQ(a.truncated, b.truncated);
      expect_equal(shaped, plain);
      if (!b.terminated && !b.truncated) continue;
      shaped.reset();
      plain.reset();
    }
  }
}

TEST(Judge, KnowsTheTaskAndWhatIsDoneOfIt) {
  bool knew = false;
  Environment room = judged("Wordgaze-Two-N8-K4-v0", [&](const babyai::Moment& moment) {
    knew = moment.task.instruction.clauses() == 2 && moment.verifier.completion().size() == 2;
    return moment.rule;
  });
  room.step(Action::left);
  EXPECT_TRUE(knew);
}

TEST(Judge, ThatFailsChangesNothing) {
  const auto broken = {
      babyai::Judge(
          [](const babyai::Moment&) -> babyai::Verdict { throw std::runtime_error("no opinion"); }),
      babyai::Judge([](const babyai::Moment&) { return babyai::Verdict{.reward = std::nan("")}; })};
  for (const auto& judge : broken) {
    Environment room = judged("BabyAI-GoToLocal-v0", judge);
    const auto before = room.serialize();
    EXPECT_ANY_THROW(room.step(Action::left));
    EXPECT_EQ(room.serialize(), before);
  }
}

// Levels of data.

TEST(PlannedLevel, RunsAndCanBeRestored) {
  for (const babyai::LevelText& text : {babyai::LevelText{.id = "Own-Map-v0",
                                       .map = "A..L\nK.D.\nX..G",
                                       .objects = "2 balls",
                                       .missions = "go to {}\nopen the door"},
                                        babyai::LevelText{.id = "Own-Rooms-v0",
                                        .room_size = 5,
                                        .columns = 2,
                                        .rows = 2,
                                        .objects = "3 objects",
                                        .missions = "go to {}, then pick up {}",
                                        .done = babyai::Done::declared}}) {
    const LevelSpec level = babyai::level_of(text);
    Environment environment(level), twin(level);
    environment.reset(5);
    core::Rng rng(3);
    for (int step = 0; step < 400; ++step) {
      twin.restore(environment.serialize());
      const auto action = static_cast<Action>(rng.below(environment.num_actions()));
      const auto a = environment.step(action), b = twin.step(action);
      ASSERT_EQ(a.reward, b.reward);
      expect_equal(environment, twin);
      if (a.terminated || a.truncated) environment.reset();
    }
  }
}

TEST(PlannedLevel, TheAgentStaysInAMapWithoutWalls) {
  Environment room(babyai::level_of({.id = "Own-Open-v0", .map = "..\n.G", .objects = ""}));
  for (int seed = 0; seed < 20; ++seed) {
    room.reset(seed);
    core::Rng rng(3);
    for (bool ended = false; !ended;) {
      const auto t = room.step(static_cast<Action>(rng.below(3)));
      ended = t.terminated || t.truncated;
      ASSERT_TRUE(room.world().grid.contains(room.world().agent));
    }
  }
}

TEST(PlannedLevel, HasNoRoomSizeToEditWhereItIsAMap) {
  const LevelSpec map = babyai::level_of({.id = "Own-Open-v0", .map = "..\n.G"});
  EXPECT_THROW(babyai::with_room(map, 9), std::invalid_argument);
  const LevelSpec rooms = babyai::level_of({.id = "Own-R-v0", .objects = "goal"});
  EXPECT_EQ(babyai::with_room(rooms, 9).room_size, 9);
}

}  // namespace
}  // namespace wordgaze::env
