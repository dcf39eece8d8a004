// What holds in every world of every level, whatever the seed.
#include <gtest/gtest.h>

#include <map>

#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/babyai/wording.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/env/random_policy.hpp"

namespace wordgaze::env {
namespace {

using grid::at;
using grid::kNothing;
using grid::kWall;
using grid::ObjectId;
using grid::Type;

constexpr std::uint64_t kFirstSeed = 900'000;

class AnyLevel : public testing::TestWithParam<std::string> {};

std::map<ObjectId, int> cells_of_objects(const grid::World& world) {
  std::map<ObjectId, int> count;
  for (int x = 0; x < world.grid.width(); ++x) {
    for (int y = 0; y < world.grid.height(); ++y) ++count[world.grid[at(x, y)]];
  }
  return count;
}

void expect_sound(const Environment& env) {
  const grid::World& world = env.world();
  ASSERT_TRUE(world.grid.contains(world.agent));
  ASSERT_TRUE(can_be_entered(world.object_at(world.agent)));
  for (const auto& [id, count] : cells_of_objects(world)) {
    ASSERT_LT(id, world.objects.size());
    const Type type = world.object(id).type;
    // Objects with an identity stand in one cell, where they say they stand.
    if (id > kWall && type != Type::lava) {
      ASSERT_EQ(count, 1);
      ASSERT_TRUE(world.stands(id));
    }
    ASSERT_EQ(world.looks[id], look_of(world.object(id)));
  }
  if (world.carried != kNothing) {
    ASSERT_TRUE(can_be_carried(world.object(world.carried)));
    ASSERT_FALSE(world.step_count > 0 && world.stands(world.carried));
  }
}

void expect_readable(const Environment& env) {
  std::array<std::uint8_t, grid::kImageBytes> image;
  env.observe(image);
  const grid::VisibleRows visible = visible_cells(env.world());
  for (int x = 0; x < grid::kViewSize; ++x) {
    for (int y = 0; y < grid::kViewSize; ++y) {
      const std::uint8_t* cell = &image[3 * (grid::kViewSize * x + y)];
      const bool seen = (visible[y] >> x & 1) != 0;
      ASSERT_EQ(cell[0] != 0, seen);
      ASSERT_TRUE(seen || cell[1] + cell[2] == 0);
      ASSERT_LT(cell[0], static_cast<int>(Type::agent));
      ASSERT_LT(cell[1], 6);
      ASSERT_LT(cell[2], 3);
    }
  }
}

void expect_worded(const Environment& env) {
  const babyai::Sentence& sentence = env.sentence();
  ASSERT_LE(sentence.length, babyai::kMaxMissionWords);
  for (int k = 0; k < sentence.length; ++k) {
    ASSERT_NE(sentence.words[k], babyai::kPadding);
    ASSERT_LT(sentence.words[k], babyai::kVocabularySize);
    ASSERT_LT(sentence.sub_task_of[k],
              std::max<int>(1, static_cast<int>(env.progress().completion().size())));
  }
  // Words and sub-tasks.
  ASSERT_TRUE(babyai::parse_sentence(env.mission()) == sentence) << env.mission();
}

TEST_P(AnyLevel, HoldsWhatEveryWorldHolds) {
  Environment env(GetParam());
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 3; ++seed) {
    env.reset(seed);
    RandomPolicy policy(env.id(), seed);
    ASSERT_NO_FATAL_FAILURE(expect_worded(env));
    for (int n = 0; n < 60; ++n) {
      ASSERT_NO_FATAL_FAILURE(expect_sound(env)) << "seed " << seed << ", step " << n;
      // The first view is older than its world where the agent carries something from the start.
      if (env.step_count() > 0) {
        ASSERT_NO_FATAL_FAILURE(expect_readable(env)) << "seed " << seed << ", step " << n;
      }
      const auto before = std::vector(env.completion().begin(), env.completion().end());
      const Transition t = env.step(policy(env));
      ASSERT_LE(t.reward, 1);
      ASSERT_GE(t.reward, -1);
      ASSERT_EQ(t.truncated, env.step_count() >= env.max_steps());
      for (std::size_t k = 0; k < before.size(); ++k) {
        ASSERT_GE(env.completion()[k], before[k]);
        ASSERT_LE(env.completion()[k] + env.declarable()[k], 1);
      }
      if (t.terminated || t.truncated) env.reset();
    }
  }
}

class InstructionLevel : public testing::TestWithParam<std::string> {};

TEST_P(InstructionLevel, SucceedsExactlyWhenAllClausesAreCompleted) {
  Environment env(GetParam());
  env.reset(kFirstSeed);
  RandomPolicy policy(env.id(), 3);
  for (int n = 0; n < 400; ++n) {
    const Transition t = env.step(policy(env));
    bool all = true;
    for (std::uint8_t done : env.completion()) all = all && done != 0;
    ASSERT_EQ(t.reward > 0, all);
    if (t.terminated || t.truncated) env.reset();
  }
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids = babyai::level_ids();
  ids.insert(
      ids.end(),
      {"Wordgaze-One-N8-K4-v0", "Wordgaze-Two-N8-K4-v0", "Wordgaze-Two-N6-K5-v0",
       "Wordgaze-Two-N8-K4-auto-v0", "Wordgaze-Three-N8-K4-v0", "Wordgaze-Four-N10-K5-v0",
       "Wordgaze-Three-N8-K4-auto-v0", "Wordgaze-One-N64-K18-v0", "Wordgaze-Six-N8-K8-v0",
       "Wordgaze-Eight-N6-K8-v0", "Wordgaze-Eight-N8-K8-v0", "Wordgaze-Eight-N8-K8-auto-v0"});
  return ids;
}

std::vector<std::string> instruction_ids() {
  std::vector<std::string> ids = all_ids();
  std::erase_if(ids, [](const std::string& id) { return id.starts_with("MiniGrid-"); });
  return ids;
}

std::string letters_and_digits(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(, AnyLevel, testing::ValuesIn(all_ids()), letters_and_digits);
INSTANTIATE_TEST_SUITE_P(, InstructionLevel, testing::ValuesIn(instruction_ids()),
                         letters_and_digits);

}  // namespace
}  // namespace wordgaze::env
