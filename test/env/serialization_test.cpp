// States that are written, read back, and damaged with their checksum made right.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "support/messages.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/env/random_policy.hpp"

namespace wordgaze::env {
namespace {

using State = std::vector<std::uint8_t>;

constexpr std::size_t kMarkBytes = 8, kFrame = 16;  // mark and checksum

void make_checksum_right(State& state) {
  std::uint64_t h = 0xCBF29CE484222325;  // FNV-1a
  for (std::size_t i = kFrame; i < state.size(); ++i) h = (h ^ state[i]) * 0x100000001B3;
  std::memcpy(state.data() + kMarkBytes, &h, sizeof h);
}

void play(Environment& env, int steps, std::uint64_t seed = 3) {
  RandomPolicy policy(env.id(), seed);
  for (int n = 0; n < steps; ++n) {
    const Transition t = env.step(policy(env));
    if (t.terminated || t.truncated) env.reset();
  }
}

/// All that is done with an environment in training, evaluation and traces.
void use(Environment& env, int steps) {
  std::array<std::uint8_t, grid::kImageBytes> image;
  RandomPolicy policy(env.id(), 5);
  for (int n = 0; n < steps; ++n) {
    env.observe(image);
    (void)env.progress();
    (void)env.mission();
    const Transition t = env.step(policy(env));
    if (t.terminated || t.truncated) break;
  }
  env.observe(image);
}

/// Whether the state was taken; what is taken must work.
bool taken(Environment& env, const State& state) {
  try {
    env.restore(state);
  } catch (const std::runtime_error&) {
    return false;
  }
  EXPECT_EQ(env.serialize(), state);
  use(env, 40);
  env.reset();
  return true;
}

std::vector<std::string> all_ids() {
  auto ids = babyai::level_ids();
  ids.insert(ids.end(), {"Wordgaze-Two-N8-K4-v0", "Wordgaze-Eight-N8-K8-v0",
                         "Wordgaze-Four-N10-K5-auto-v0", "BabyAI-GoToLocal-v0[room_size=9]"});
  return ids;
}

TEST(Serialization, TakesEveryStateOfEveryLevel) {
  for (const std::string& id : all_ids()) {
    Environment env(id), other(id);
    env.reset(std::uint64_t{11});
    for (int n = 0; n < 40; ++n) {
      const State state = env.serialize();
      ASSERT_NO_THROW(other.restore(state)) << id << ", step " << n;
      ASSERT_EQ(other.serialize(), state) << id;
      play(env, 5, static_cast<std::uint64_t>(n));
    }
  }
}

TEST(Serialization, TakesStatesThatCurriculaMake) {
  Environment env("Wordgaze-Three-N8-K6-v0"), other("Wordgaze-Three-N8-K6-v0");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    env.reset(seed);
    env.mark_completed(
        static_cast<int>(std::ranges::find(env.declarable(), 1) - env.declarable().begin()));
    EXPECT_NO_THROW(other.restore(env.serialize()));
    env.set_instruction(babyai::single(env.instruction().clause[1]));
    for (grid::ObjectId id = grid::kWall + 1; id < env.world().objects.size(); ++id) {
      if (!env.world().stands(id) || env.world().carried != grid::kNothing) continue;
      env.take_object(id);
    }
    EXPECT_NO_THROW(other.restore(env.serialize()));
    play(env, 3);
    EXPECT_NO_THROW(other.restore(env.serialize()));
  }
}

TEST(Serialization, TakesTheStateBeforeTheFirstReset) {
  Environment env("BabyAI-GoTo-v0"), other("BabyAI-GoTo-v0");
  other.reset(std::uint64_t{1});
  other.restore(env.serialize());
  EXPECT_EQ(other.serialize(), env.serialize());
  EXPECT_THROW(other.step(grid::Action::left), std::logic_error);
}

TEST(Serialization, OneEpisodeHasOneForm) {
  // What ran in this thread before leaves no trace, nor what lay on the stack.
  Environment other("BabyAI-BossLevel-v0"), env("Wordgaze-One-N8-K4-v0");
  other.reset(std::uint64_t{1});
  env.reset(std::uint64_t{2});
  State elsewhere;
  std::thread([&] {
    Environment fresh("Wordgaze-One-N8-K4-v0");
    fresh.reset(std::uint64_t{2});
    elsewhere = fresh.serialize();
  }).join();
  EXPECT_EQ(env.serialize(), elsewhere);
}

TEST(Serialization, AnyByteAlteredIsRefusedOrDoesNoHarm) {
  int refused = 0, tries = 0;
  for (const char* id :
       {"Wordgaze-Two-N8-K4-v0", "BabyAI-KeyInBox-v0", "BabyAI-PutNextS5N2Carrying-v0",
        "BabyAI-SynthS5R2-v0", "MiniGrid-Dynamic-Obstacles-5x5-v0", "MiniGrid-MemoryS7-v0",
        "MiniGrid-Fetch-5x5-N2-v0", "MiniGrid-ObstructedMaze-1Dlhb-v0"}) {
    Environment env(id), other(id);
    env.reset(std::uint64_t{4});
    for (const int steps : {0, 9}) {
      play(env, steps);
      const State state = env.serialize();
      for (std::size_t i = kFrame; i < state.size(); ++i) {
        for (const int change : {0x01, 0x80, 0xff, 0x40, 0x06}) {
          State altered = state;
          altered[i] ^= static_cast<std::uint8_t>(change);
          make_checksum_right(altered);
          ++tries;
          refused += !taken(other, altered);
        }
      }
    }
  }
  EXPECT_GT(refused, tries / 2) << "of " << tries;
}

TEST(Serialization, TwoBytesAlteredAreRefusedOrDoNoHarm) {
  core::Rng rng(1);
  for (const char* id : {"Wordgaze-Three-N6-K5-v0", "BabyAI-KeyInBox-v0",
                         "MiniGrid-Dynamic-Obstacles-Random-6x6-v0"}) {
    Environment env(id), other(id);
    env.reset(std::uint64_t{5});
    play(env, 7);
    const State state = env.serialize();
    for (int tries = 0; tries < 4000; ++tries) {
      State altered = state;
      for (int k = 0; k < 2; ++k) {
        const int at = rng.below(static_cast<int>(state.size() - kFrame));
        altered[kFrame + static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(rng.below(256));
      }
      make_checksum_right(altered);
      taken(other, altered);
    }
  }
}

TEST(Serialization, AnyLengthButItsOwnIsRefused) {
  Environment env("Wordgaze-One-N8-K4-v0");
  env.reset(std::uint64_t{1});
  const State state = env.serialize();
  for (std::size_t size = 0; size < state.size(); ++size) {
    State cut(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(size));
    if (size >= kFrame) make_checksum_right(cut);
    EXPECT_THROW(env.restore(cut), std::runtime_error);
  }
  State longer = state;
  longer.push_back(0);
  make_checksum_right(longer);
  EXPECT_THROW(env.restore(longer), std::runtime_error);
  EXPECT_EQ(env.serialize(), state);
}

TEST(Serialization, SaysWhatIsDamaged) {
  Environment env("Wordgaze-One-N8-K4-v0");
  env.reset(std::uint64_t{1});
  State state = env.serialize();
  // The last member of the grid: its frame at the lower right.
  const std::size_t verifier = 1 + 1 + 4 * 8 + 8;
  state[state.size() - verifier - 1] = 255;
  make_checksum_right(state);
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { env.restore(state); }),
                       "restore: the state is damaged: size or frame of the grid"));
}

TEST(Serialization, ReadsTheFormerForm) {
  std::ifstream file(WORDGAZE_TEST_DATA "/env/former_states.txt");
  std::string id, digits;
  int states = 0;
  for (; file >> id >> digits; ++states) {
    State state;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
      state.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    }
    Environment env(id), played(id);
    env.restore(state);
    played.reset(std::uint64_t{7});
    play(played, 9);
    EXPECT_EQ(env.serialize(), played.serialize()) << id;
    // The look of the first object; it stands behind the table of objects.
    const std::size_t objects = kFrame + 8 + id.size() + 1 + 48 + 1 + 424;
    const std::size_t looks = objects + 8 + 8 * env.world().objects.size();
    state[looks + 2] ^= 0x10;
    make_checksum_right(state);
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { env.restore(state); }), "look"));
  }
  EXPECT_EQ(states, 3);
}

}  // namespace
}  // namespace wordgaze::env
