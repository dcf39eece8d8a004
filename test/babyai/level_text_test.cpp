#include "wordgaze/babyai/level_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "wordgaze/babyai/generator.hpp"
#include "wordgaze/babyai/layout.hpp"

namespace wordgaze::babyai {
namespace {

using grid::at;
using grid::Color;
using grid::Direction;
using grid::DoorState;
using grid::Type;

struct Drawn {
  grid::World world;
  Task task;
};

Drawn draw(const LevelSpec& level, std::uint64_t seed = 1) {
  Drawn drawn;
  core::Rng rng(seed);
  EXPECT_TRUE(generate(level, rng, drawn.world, drawn.task));
  return drawn;
}

const LevelText kRoom{.id = "Own-Room-v0",
                      .map = R"(
########
#>.#..G#
#..D.L.#
#k.#..x#
########
)",
                      .legend = "D = locked red door\nk = red key\nx = open green door",
                      .missions = "open the red door"};

int count(const grid::World& world, Type type) {
  return static_cast<int>(std::ranges::count(world.objects.begin() + 2, world.objects.end(), type,
                                             &grid::Object::type));
}

TEST(LevelText, AMapIsTheWorld) {
  const Drawn drawn = draw(level_of(kRoom));
  const grid::World& world = drawn.world;
  EXPECT_EQ(world.grid.width(), 8);
  EXPECT_EQ(world.grid.height(), 5);
  EXPECT_EQ(world.agent, at(1, 1));
  EXPECT_EQ(world.direction, Direction::right);
  const auto expect = [&](int x, int y, Type type, Color color, DoorState state) {
    const grid::Object& object = world.object_at(at(x, y));
    EXPECT_EQ(object.type, type) << x << ' ' << y;
    EXPECT_EQ(object.color, color) << x << ' ' << y;
    EXPECT_EQ(object.state, state) << x << ' ' << y;
  };
  expect(0, 0, Type::wall, Color::grey, DoorState::open);
  expect(3, 1, Type::wall, Color::grey, DoorState::open);
  expect(2, 1, Type::empty, Color::red, DoorState::open);
  expect(3, 2, Type::door, Color::red, DoorState::locked);
  expect(1, 3, Type::key, Color::red, DoorState::open);
  expect(6, 3, Type::door, Color::green, DoorState::open);
  expect(6, 1, Type::goal, Color::green, DoorState::open);
  expect(5, 2, Type::lava, Color::red, DoorState::open);
  EXPECT_EQ(text(drawn.task.sentence), "open the red door");
  EXPECT_EQ(drawn.task.max_steps, 64);
}

TEST(LevelText, WhatIsNotSaidIsDrawn) {
  LevelText text = kRoom;
  text.map = "D...\nK.B.\nX..#\n";
  text.legend = "";
  text.missions = "go to {}";
  const LevelSpec level = level_of(text);
  std::set<int> colors, agents, directions;
  std::set<std::string> missions;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Drawn drawn = draw(level, seed);
    colors.insert(static_cast<int>(drawn.world.object_at(at(0, 0)).color));
    EXPECT_EQ(drawn.world.object_at(at(0, 0)).state, DoorState::closed);
    agents.insert(drawn.world.agent.y * 4 + drawn.world.agent.x);
    directions.insert(static_cast<int>(drawn.world.direction));
    missions.insert(babyai::text(drawn.task.sentence));
    EXPECT_EQ(drawn.world.grid[drawn.world.agent], grid::kNothing);
  }
  EXPECT_EQ(colors.size(), 6u);
  EXPECT_EQ(agents.size(), 7u);
  EXPECT_EQ(directions.size(), 4u);
  EXPECT_GT(missions.size(), 12u);
}

TEST(LevelText, ObjectsArePlacedAtRandom) {
  LevelText text = kRoom;
  text.objects = "blue key\n2 balls\n\n3 boxes\n1 purple ball\n2 objects\n0 keys";
  const LevelSpec level = level_of(text);
  std::set<int> places;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Drawn drawn = draw(level, seed);
    const auto& objects = drawn.world.objects;
    EXPECT_EQ(count(drawn.world, Type::key) + count(drawn.world, Type::ball) +
                  count(drawn.world, Type::box),
              10);
    EXPECT_GE(count(drawn.world, Type::box), 3);
    const auto blue = std::ranges::find_if(objects, [](const grid::Object& o) {
      return o.type == Type::key && o.color == Color::blue;
    });
    ASSERT_NE(blue, objects.end());
    places.insert(blue->position.y * 8 + blue->position.x);
    // No two alike, where they are drawn.
    std::set<int> kinds;
    int things = 0;
    for (const auto& o : objects) {
      if (!grid::can_be_carried(o)) continue;
      ++things;
      kinds.insert(static_cast<int>(o.type) * 6 + static_cast<int>(o.color));
    }
    EXPECT_EQ(static_cast<int>(kinds.size()), things);
  }
  EXPECT_GT(places.size(), 6u);
}

TEST(LevelText, RoomsAreJoinedByDoors) {
  const LevelSpec level = level_of({.id = "Own-Rooms-v0",
                                    .room_size = 6,
                                    .columns = 3,
                                    .rows = 2,
                                    .objects = "4 objects",
                                    .missions = "go to {}, then pick up {}\nopen a door"});
  std::set<int> verbs;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Drawn drawn = draw(level, seed);
    EXPECT_EQ(drawn.world.grid.width(), 16);
    EXPECT_GE(count(drawn.world, Type::door), 5);
    verbs.insert(static_cast<int>(drawn.task.instruction.clause[0].verb));
    if (drawn.task.instruction.clauses() == 2) {
      EXPECT_NE(drawn.task.instruction.clause[0].object, drawn.task.instruction.clause[1].object);
    }
  }
  EXPECT_EQ(verbs.size(), 2u);
}

TEST(LevelText, WithoutMissionsTheGoalIsTheTask) {
  LevelText text = kRoom;
  text.missions = "";
  const LevelSpec level = level_of(text);
  EXPECT_EQ(level.rule, Rule::goal);
  const Drawn drawn = draw(level);
  EXPECT_EQ(babyai::text(drawn.task.sentence), "get to the green goal square");
  EXPECT_EQ(drawn.task.max_steps, 4 * 8 * 5);
}

TEST(LevelText, DeclaredClausesAreSequential) {
  LevelText text = kRoom;
  text.done = Done::declared;
  EXPECT_EQ(level_of(text).done_mode, DoneMode::sequential);
}

TEST(LevelText, ManyCellsOfOneKindAreOneObject) {
  std::string map = "A";
  map += std::string(200, 'L') + "G\n" + std::string(202, '#');
  const LevelSpec level = level_of({.id = "Own-Lava-v0", .map = map});
  EXPECT_LE(draw(level).world.objects.size(), 4u);
}

/// A mistake, and what the message must say.
struct Mistake {
  const char* says;
  LevelText text;
};

LevelText with(auto&& change) {
  LevelText text = kRoom;
  change(text);
  return text;
}

TEST(LevelText, MistakesAreNamed) {
  const std::vector<Mistake> mistakes{
      {"id", with([](auto& t) { t.id = ""; })},
      {"id", with([](auto& t) { t.id = "with space"; })},
      {"built-in", with([](auto& t) { t.id = "BabyAI-GoToLocal-v0"; })},
      {"row 2 has 3 letters, the first one 4", with([](auto& t) { t.map = "####\n#A#"; })},
      {"row 1, column 3: the letter '?'", with([](auto& t) { t.map = "#A?"; })},
      {"code 7", with([](auto& t) { t.map = "#A\a"; })},
      {"two agents", with([](auto& t) { t.map = "#A>"; })},
      {"one cell", with([](auto& t) { t.map = "A"; })},
      {"1024 columns", with([](auto& t) { t.map = std::string(1025, '.'); })},
      {"'k = '", with([](auto& t) { t.legend = "k = "; })},
      {"'. = key'", with([](auto& t) { t.legend = ". = key"; })},
      {"'kk = key'", with([](auto& t) { t.legend = "kk = key"; })},
      {"'k = bleu key'", with([](auto& t) { t.legend = "k = bleu key"; })},
      {"'k = locked key'", with([](auto& t) { t.legend = "k = locked key"; })},
      {"'k = blue goal'", with([](auto& t) { t.legend = "k = blue goal"; })},
      {"'k = agent'", with([](auto& t) { t.legend = "k = agent"; })},
      {"no map", with([](auto& t) { t.map = ""; })},
      {"'two balls'", with([](auto& t) { t.objects = "two balls"; })},
      {"'-1 balls'", with([](auto& t) { t.objects = "-1 balls"; })},
      {"'99999 balls'", with([](auto& t) { t.objects = "99999 balls"; })},
      {"'red door'", with([](auto& t) { t.objects = "red door"; })},
      {"20 objects", with([](auto& t) {
         t.objects = "20 keys";
         t.distinct = false;
       })},
      {"go home", with([](auto& t) { t.missions = "go home"; })},
      {"nothing in the level can be a blue ball",
       with([](auto& t) { t.missions = "go to the blue ball"; })},
      {"more gaps", with([](auto& t) { t.missions = "put {} next to {}"; })},
      {"more gaps", with([](auto& t) { t.missions = "open {} and pick up {}, then pick up {}"; })},
      {"distinct = false", with([](auto& t) { t.objects = "6 keys"; })},
      {"distinct = false", LevelText{.id = "X", .objects = "19 objects", .missions = "go to {}"}},
      {"no goal to reach", with([](auto& t) {
         t.missions = "";
         t.map = "A...";
         t.legend = "";
       })},
      {"done", with([](auto& t) {
         t.missions = "";
         t.done = Done::declared;
       })},
      {"columns", LevelText{.id = "X", .columns = 9, .rows = 9, .objects = "goal"}},
      {"room_size", LevelText{.id = "X", .room_size = 2, .objects = "goal"}},
      {"holds at most", LevelText{.id = "X",
                                  .room_size = 30,
                                  .objects = "63 keys",
                                  .distinct = false,
                                  .missions = "go to {}"}},
  };
  for (const auto& [says, text] : mistakes) {
    try {
      level_of(text);
      ADD_FAILURE() << "not refused: " << says;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos)
          << says << " is not in: " << error.what();
    }
  }
}

TEST(LevelText, WhatCanNeverBeDrawnIsSaidAtOnce) {
  // Both balls are red, so no two gaps can be filled with different things.
  const LevelText text{.id = "Own-Alike-v0",
                       .map = "bA\nb.",
                       .legend = "b = red ball",
                       .missions = "go to {} and pick up {}"};
  EXPECT_THROW(level_of(text), std::invalid_argument);
}

TEST(LevelText, AsManyAsThereAreColorsCanBeUnlike) {
  const LevelSpec level = level_of(
      {.id = "Own-Keys-v0", .objects = "5 keys\nred key\n6 objects", .missions = "go to {}"});
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_EQ(count(draw(level, seed).world, Type::key), 6);
  }
}

TEST(LevelText, APlanOfOnesOwnIsValidated) {
  const LevelSpec good = level_of(kRoom);
  const auto broken = [&](auto&& change) {
    LevelSpec level = good;
    auto plan = std::get<Plan>(level.parameters);
    change(plan);
    level.parameters = plan;
    EXPECT_THROW(validate(level), std::invalid_argument);
  };
  broken([](Plan& p) { p.cells.push_back({.place = at(8, 0)}); });
  broken([](Plan& p) { p.agent = at(0, 5); });
  broken([](Plan& p) { p.width = kMaxGridSide + 1; });
  broken([](Plan& p) { p.missions.clear(); });
  broken([](Plan& p) { p.objects.assign(63, {}); });
}

}  // namespace
}  // namespace wordgaze::babyai
