#include "wordgaze/env/environment.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "wordgaze/env/random_policy.hpp"

namespace wordgaze::env {
namespace {

using babyai::Verb;
using grid::Action;

using Image = std::array<std::uint8_t, grid::kImageBytes>;

Image image_of(const Environment& env) {
  Image image;
  env.observe(image);
  return image;
}

// Both behave alike for a while, across resets.
void expect_equal_futures(Environment& a, Environment& b) {
  RandomPolicy policy(a.id(), 1);
  for (int n = 0; n < 300; ++n) {
    ASSERT_EQ(image_of(a), image_of(b));
    ASSERT_EQ(a.mission(), b.mission());
    const Action action = policy(a);
    const Transition ta = a.step(action), tb = b.step(action);
    ASSERT_EQ(ta.reward, tb.reward);
    ASSERT_EQ(ta.terminated, tb.terminated);
    ASSERT_EQ(ta.truncated, tb.truncated);
    ASSERT_TRUE(std::ranges::equal(a.completion(), b.completion()));
    if (ta.terminated || ta.truncated) {
      a.reset();
      b.reset();
    }
    ASSERT_EQ(a.rng().state(), b.rng().state());
  }
}

void play(Environment& env, int steps) {
  RandomPolicy policy(env.id(), 2);
  for (int n = 0; n < steps; ++n) {
    const Transition t = env.step(policy(env));
    if (t.terminated || t.truncated) env.reset();
  }
}

class AnyEnvironment : public testing::TestWithParam<const char*> {};

TEST_P(AnyEnvironment, IsAValue) {
  Environment env(GetParam());
  env.reset(4);
  play(env, 37);
  Environment copy = env;
  expect_equal_futures(env, copy);
}

TEST_P(AnyEnvironment, ResumesFromItsSerializedState) {
  Environment env(GetParam());
  env.reset(5);
  play(env, 41);
  Environment other(GetParam());
  other.restore(env.serialize());
  expect_equal_futures(env, other);
}

INSTANTIATE_TEST_SUITE_P(, AnyEnvironment,
                         testing::Values("Wordgaze-Two-N8-K4-v0", "BabyAI-MiniBossLevel-v0",
                                         "BabyAI-PutNextS5N2Carrying-v0", "BabyAI-KeyInBox-v0",
                                         "MiniGrid-Dynamic-Obstacles-6x6-v0",
                                         "MiniGrid-MemoryS13Random-v0"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

TEST(Environment, RefusesToRestoreForeignBytesAndStaysAsItWas) {
  Environment env("Wordgaze-One-N8-K4-v0");
  env.reset(1);
  const auto state = env.serialize();
  auto corrupted = state;
  corrupted[corrupted.size() / 2] ^= 1;
  EXPECT_THROW(env.restore(corrupted), std::runtime_error);
  EXPECT_THROW(env.restore(std::span(state).first(state.size() - 1)), std::runtime_error);
  EXPECT_THROW(env.restore({}), std::runtime_error);
  Environment other("Wordgaze-One-N8-K5-v0");
  EXPECT_THROW(other.restore(state), std::runtime_error);
  EXPECT_EQ(env.serialize(), state);
}

TEST(Environment, OffersTheNearestIdsForAnUnknownOne) {
  try {
    Environment env("BabyAI-GoToLocl-v0");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("BabyAI-GoToLocal-v0"), std::string::npos);
  }
}

TEST(Environment, SaysWhyTheLevelsWithPatternsAreMissing) {
  try {
    Environment env("MiniGrid-WFC-MazeSimple-v0");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("patterns"), std::string::npos);
  }
}

TEST(Environment, RefusesARoomThatIsTooSmall) {
  EXPECT_THROW(Environment("Wordgaze-One-N4-K1-v0"), std::invalid_argument);
  EXPECT_THROW(Environment("Wordgaze-One-N5-K5-v0"), std::invalid_argument);
  EXPECT_THROW(Environment("Wordgaze-One-N8-K19-v0"), std::invalid_argument);
  EXPECT_THROW(Environment("Wordgaze-Two-N8-K1-v0"), std::invalid_argument);
  EXPECT_THROW(Environment("Wordgaze-One-N8-K0-v0"), std::invalid_argument);
}

TEST(Environment, TakesAnyRoomThatFits) {
  for (const char* id : {"Wordgaze-One-N5-K4-v0", "Wordgaze-Two-N6-K8-v0",
                         "Wordgaze-Two-N64-K18-v0", "Wordgaze-One-N9-K1-auto-v0"}) {
    Environment env(id);
    for (std::uint64_t seed = 0; seed < 20; ++seed) env.reset(seed);
  }
}

TEST(Environment, RefusesAnActionOutOfRangeAndStaysAsItWas) {
  Environment env("MiniGrid-Dynamic-Obstacles-6x6-v0");
  env.reset(1);
  const auto before = env.serialize();
  EXPECT_THROW(env.step(Action::pickup), std::invalid_argument);
  EXPECT_EQ(env.serialize(), before);
  Environment full("BabyAI-GoToLocal-v0");
  full.reset(1);
  EXPECT_THROW(full.step(static_cast<Action>(7)), std::invalid_argument);
}

TEST(Environment, RefusesANegativeSeedAndStaysAsItWas) {
  Environment env("BabyAI-GoToLocal-v0");
  env.reset(3);
  const auto before = env.serialize();
  EXPECT_THROW(env.reset(-1), std::invalid_argument);
  EXPECT_EQ(env.serialize(), before);
}

template <class T>
concept TakenAsSeed = requires(Environment& env, T seed) {
  env.reset(seed);
};
static_assert(TakenAsSeed<int> && TakenAsSeed<std::uint64_t> && TakenAsSeed<core::Seed>);
static_assert(!TakenAsSeed<double> && !TakenAsSeed<float>);

TEST(Environment, RefusesToStepBeforeTheFirstReset) {
  Environment env("BabyAI-GoToLocal-v0");
  EXPECT_THROW(env.step(Action::left), std::logic_error);
}

TEST(Environment, StartsFromDifferentSeedsWhenNoneIsGiven) {
  Environment a("BabyAI-GoToLocal-v0"), b("BabyAI-GoToLocal-v0");
  a.reset();
  b.reset();
  EXPECT_NE(a.rng().state(), b.rng().state());
}

// The reference never returns from this reset.
TEST(Environment, GivesUpOnALayoutThatDoesNotExistAndStaysAsItWas) {
  Environment env("BabyAI-SynthS5R2-v0");
  env.reset(0);
  const auto before = env.serialize();
  try {
    env.reset(1741);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("BabyAI-SynthS5R2-v0"), std::string::npos) << what;
    EXPECT_NE(what.find("1741"), std::string::npos) << what;
  }
  EXPECT_EQ(env.serialize(), before);
}

// Any other object of this world than the one of the first clause.
babyai::Description another_object(const Environment& env) {
  for (std::size_t id = 2; id < env.world().objects.size(); ++id) {
    const grid::Object& o = env.world().objects[id];
    const babyai::Description d{.type = o.type, .color = o.color};
    if (d != env.instruction().clause[0].object) return d;
  }
  return {};
}

TEST(Environment, TakesAnotherInstruction) {
  Environment env("Wordgaze-One-N8-K4-v0");
  env.reset(3);
  const babyai::Clause go{.verb = Verb::go_to, .object = env.instruction().clause[0].object};
  const babyai::Clause pick{.verb = Verb::pickup, .object = another_object(env)};
  env.set_instruction(babyai::ordered(single(go), babyai::Order::before, single(pick)));
  EXPECT_EQ(env.instruction().clauses(), 2);
  EXPECT_EQ(env.completion().size(), 2u);
  EXPECT_EQ(env.max_steps(), 2 * 64);
  EXPECT_EQ(env.mission().rfind("go to the ", 0), 0u);
  EXPECT_NE(env.mission().find(", then pick up the "), std::string::npos);
  EXPECT_EQ(env.declarable()[0], 1);
  EXPECT_EQ(env.declarable()[1], 0);
}

TEST(Environment, RefusesAnInstructionThatMeansNothingHereAndStaysAsItWas) {
  Environment env("Wordgaze-One-N8-K4-v0");
  env.reset(3);
  const auto before = env.serialize();
  const babyai::Clause door{.verb = Verb::open, .object = {.type = grid::Type::door}};
  EXPECT_THROW(env.set_instruction(babyai::single(door)), std::invalid_argument);
  EXPECT_THROW(env.set_instruction({}), std::invalid_argument);
  EXPECT_EQ(env.serialize(), before);
  Environment other("MiniGrid-Empty-5x5-v0");
  other.reset(0);
  EXPECT_THROW(other.set_instruction(env.instruction()), std::invalid_argument);
}

// One that asks for two things in an order.
Environment two_clauses(babyai::Order order) {
  Environment env("Wordgaze-Two-N8-K4-v0");
  for (std::uint64_t seed = 0;; ++seed) {
    env.reset(seed);
    if (env.instruction().order[1] == order) return env;
  }
}

TEST(Environment, MarksAClauseAsDone) {
  Environment env = two_clauses(babyai::Order::after);
  EXPECT_EQ(env.declarable()[0], 0);
  EXPECT_EQ(env.declarable()[1], 1);
  EXPECT_THROW(env.mark_completed(0), std::invalid_argument);  // not its turn
  env.mark_completed(1);
  EXPECT_EQ(env.completion()[1], 1);
  EXPECT_EQ(env.declarable()[0], 1);
  EXPECT_THROW(env.mark_completed(0), std::invalid_argument);  // the last one left
  EXPECT_THROW(env.mark_completed(2), std::invalid_argument);
}

TEST(Environment, MovesAnObjectToAnEmptyCell) {
  Environment env("Wordgaze-One-N8-K1-v0");
  env.reset(3);
  const grid::ObjectId object = grid::kWall + 1;
  const grid::Position home = env.world().object(object).position;
  grid::Position to{1, 1};
  while (env.world().grid[to] != grid::kNothing || to == env.world().agent) ++to.x;
  env.move_object(object, to);
  EXPECT_EQ(env.world().grid[home], grid::kNothing);
  EXPECT_EQ(env.world().grid[to], object);
  EXPECT_TRUE(env.world().stands(object));
  EXPECT_THROW(env.move_object(object, env.world().agent), std::invalid_argument);
  EXPECT_THROW(env.move_object(object, {0, 0}), std::invalid_argument);
  EXPECT_THROW(env.move_object(object, {99, 0}), std::invalid_argument);
  EXPECT_THROW(env.move_object(grid::kWall, home), std::invalid_argument);
}

TEST(Environment, StartsWithAnObjectInHand) {
  Environment env("BabyAI-PutNextLocal-v0");
  env.reset(3);
  const grid::ObjectId object = grid::kWall + 1;
  const grid::Position home = env.world().object(object).position;
  env.take_object(object);
  EXPECT_EQ(env.world().carried, object);
  EXPECT_EQ(env.world().grid[home], grid::kNothing);
  EXPECT_THROW(env.take_object(object), std::invalid_argument);      // carried already
  EXPECT_THROW(env.take_object(object + 1), std::invalid_argument);  // the hand is full
  EXPECT_THROW(env.take_object(grid::kWall), std::invalid_argument);
}

TEST(Environment, EndsWhenNothingIsLeftToBeDeclared) {
  Environment env = two_clauses(babyai::Order::any);
  const Transition t = env.step(Action::done);
  EXPECT_TRUE(t.terminated);
  EXPECT_EQ(t.reward, 0);
}

TEST(Environment, TruncatesAtItsStepLimit) {
  for (const char* id : {"BabyAI-PickupDist-v0", "MiniGrid-Empty-5x5-v0"}) {
    Environment env(id);
    env.reset(0);
    const int limit = env.max_steps();
    EXPECT_EQ(limit, id[0] == 'B' ? 49 : 100);
    for (int n = 1; n < limit; ++n) {
      const Transition t = env.step(Action::left);
      ASSERT_FALSE(t.truncated || t.terminated) << id << ' ' << n;
    }
    const Transition last = env.step(Action::left);
    EXPECT_TRUE(last.truncated) << id;
    EXPECT_FALSE(last.terminated) << id;
    EXPECT_EQ(last.reward, 0) << id;
  }
}

TEST(Environment, JoinsThreeAndFourClausesInEveryWayOfTheGrammar) {
  for (const auto& [id, ways] :
       {std::pair{"Wordgaze-Three-N8-K4-v0", 4u}, std::pair{"Wordgaze-Four-N8-K4-v0", 2u}}) {
    Environment env(id);
    std::set<std::pair<int, babyai::Order>> seen;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      env.reset(seed);
      const auto& instruction = env.instruction();
      const int first = instruction.part_at(0).end;
      seen.emplace(first, instruction.order[static_cast<std::size_t>(first)]);
      std::set<std::pair<int, int>> kinds;
      for (int k = 0; k < instruction.clauses(); ++k) {
        const auto& object = instruction.clause[static_cast<std::size_t>(k)].object;
        kinds.emplace(static_cast<int>(object.type.value()),
                      static_cast<int>(object.color.value()));
      }
      EXPECT_EQ(kinds.size(), static_cast<std::size_t>(instruction.clauses())) << seed;
    }
    EXPECT_EQ(seen.size(), ways) << id;
  }
}

TEST(Environment, ChainsMoreThanFourClauses) {
  for (const auto& [id, clauses] :
       {std::pair{"Wordgaze-Five-N8-K8-v0", 5}, std::pair{"Wordgaze-Six-N8-K8-v0", 6},
        std::pair{"Wordgaze-Seven-N8-K8-v0", 7}, std::pair{"Wordgaze-Eight-N8-K8-auto-v0", 8}}) {
    Environment env(id);
    std::set<int> afters, parts;
    int with_after = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      env.reset(seed);
      const auto& instruction = env.instruction();
      ASSERT_TRUE(is_grammatical(instruction));
      ASSERT_EQ(instruction.clauses(), clauses);
      ASSERT_EQ(env.max_steps(), 64 * clauses);
      afters.insert(instruction.behind_after());
      with_after += instruction.behind_after() > 0;
      int count = 0, done = 0;
      for (auto p = instruction.first(); p.size() > 0; p = instruction.next(p)) {
        ++count;
        done += p.size();
      }
      ASSERT_EQ(done, clauses);
      parts.insert(count);
      grid::ObjectSet targets = 0;
      for (int k = 0; k < clauses; ++k)
        targets |= env.meaning().object[static_cast<std::size_t>(k)];
      ASSERT_EQ(std::popcount(targets), clauses) << seed;
    }
    EXPECT_NEAR(with_after, 200, 40) << id;
    EXPECT_EQ(*parts.begin(), (clauses + 1) / 2) << id;  // all pairs
    EXPECT_EQ(afters.size(), static_cast<std::size_t>(clauses))
        << id;  // none, or before any clause
  }
}

TEST(Environment, DoesTheClausesOfAChainInTheirOrder) {
  Environment env("Wordgaze-Eight-N8-K8-v0");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    env.reset(seed);
    const babyai::Instruction i = env.instruction();
    for (auto part = i.first(); part.size() > 0; part = i.next(part)) {
      for (int k = 0; k < i.clauses(); ++k) {
        ASSERT_EQ(env.declarable()[static_cast<std::size_t>(k)], k >= part.begin && k < part.end);
      }
      if (i.next(part).size() == 0) break;  // the last clause cannot be marked
      for (int k = part.begin; k < part.end; ++k) env.mark_completed(k);
    }
  }
}

TEST(Environment, RefusesAnInstructionThatIsNotOfTheGrammar) {
  Environment env("Wordgaze-Three-N8-K4-v0");
  env.reset(1);
  babyai::Instruction i = env.instruction();
  i.order = {};
  EXPECT_THROW(env.set_instruction(i), std::invalid_argument);
  i.count = 200;
  EXPECT_THROW(env.set_instruction(i), std::invalid_argument);
}

TEST(Environment, GoesOnWithTheRandomStreamThatItIsGiven) {
  Environment a("MiniGrid-Dynamic-Obstacles-6x6-v0"), b(a), c(a);
  a.reset(3);
  b.reset(4);
  b.reset(core::Rng(3));  // a stream, not a seed of another one
  EXPECT_EQ(a.serialize(), b.serialize());
  c.reset(3);
  c.set_rng(core::Rng(9));
  EXPECT_NE(a.rng().state(), c.rng().state());
  a.step(Action::left);
  c.step(Action::left);
  EXPECT_NE(a.serialize(), c.serialize());  // other obstacles have moved, or other ways
}

}  // namespace
}  // namespace wordgaze::env
