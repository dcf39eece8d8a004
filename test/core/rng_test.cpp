#include "wordgaze/core/rng.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wordgaze::core {
namespace {

using Json = nlohmann::json;

// Written by scripts/golden/rng_vectors.py with NumPy.
std::vector<Json> cases() {
  std::ifstream file(WORDGAZE_TEST_DATA "/rng/vectors.json");
  return Json::parse(file).at("cases");
}

Rng::State state_of(const Json& json) {
  const auto word = [&](const char* key, int half) {
    return std::stoull(json.at(key).get<std::string>().substr(16 * half, 16), nullptr, 16);
  };
  return {word("state", 0),
          word("state", 1),
          word("increment", 0),
          word("increment", 1),
          json.at("half").get<std::uint32_t>(),
          json.at("has_half").get<bool>()};
}

TEST(Rng, IsSeededAsNumPyWithSeedsOfAnySize) {
  for (const Json& c : cases()) {
    const Rng rng(Seed::parse(c.at("seed").get<std::string>()));
    EXPECT_EQ(rng.state(), state_of(c.at("seeded"))) << "seed " << c.at("seed");
  }
}

TEST(Rng, DrawsAsNumPy) {
  for (const Json& c : cases()) {
    Rng rng(Seed::parse(c.at("seed").get<std::string>()));
    for (const Json& call : c.at("calls")) {
      SCOPED_TRACE("seed " + c.at("seed").get<std::string>() + ", call " + call.dump());
      const std::string kind = call[0];
      if (kind == "integers") {
        ASSERT_EQ(rng.integer(call[1], call[2]), call[3].get<std::int64_t>());
      } else if (kind == "uniform") {
        ASSERT_EQ(rng.uniform(), std::stod(call[1].get<std::string>()));
      } else {
        std::vector<int> items(call[1].size());
        std::iota(items.begin(), items.end(), 0);
        rng.shuffle(std::span(items));
        ASSERT_EQ(items, call[1].get<std::vector<int>>());
      }
      ASSERT_EQ(int{rng.state().has_half}, call.back().get<int>());
    }
    EXPECT_EQ(rng.state(), state_of(c.at("end")));
  }
}

TEST(Rng, BelowIsIntegerFromZero) {
  Rng a(5), b(5);
  for (int n = 1; n < 2000; ++n) ASSERT_EQ(a.below(n), b.integer(0, n));
}

TEST(Rng, DrawsNothingFromARangeOfOneValue) {
  Rng rng(1);
  const Rng::State before = rng.state();
  EXPECT_EQ(rng.below(1), 0);
  EXPECT_EQ(rng.integer(7, 8), 7);
  EXPECT_EQ(rng.state(), before);
}

TEST(Rng, GoesOnFromItsStateBufferedHalfIncluded) {
  Rng rng(9);
  rng.next32();
  Rng restored(rng.state());
  EXPECT_TRUE(restored.state().has_half);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(restored.next32(), rng.next32());
}

TEST(Rng, RefusesAnEmptyRange) {
  Rng rng(0);
  EXPECT_THROW(rng.integer(3, 3), std::invalid_argument);
  EXPECT_THROW(rng.integer(3, 2), std::invalid_argument);
}

TEST(Seed, ReadsAndWritesDigitsOfAnyLength) {
  for (const char* digits : {"0", "7", "4294967296", "18446744073709551616",
                             "340282366920938463463374607431768211507"}) {
    EXPECT_EQ(Seed::parse(digits).text(), digits);
  }
  EXPECT_EQ(Seed::parse("18446744073709551615").text(), Seed(~std::uint64_t{0}).text());
}

TEST(Seed, RefusesWhatIsNoNonNegativeInteger) {
  for (const char* text : {"", "-1", "+1", "1.5", "1e3", " 1", "0x10"}) {
    EXPECT_THROW(Seed::parse(text), std::invalid_argument) << '\'' << text << '\'';
  }
}

TEST(Seed, HasABoundedNumberOfDigits) {
  const std::string long_one(10'000, '7');
  EXPECT_EQ(Seed::parse(long_one).text(), long_one);
  try {
    Seed::parse(std::string(1'000'000, '7'));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_LT(std::string_view(error.what()).size(), 300u);
  }
}

}  // namespace
}  // namespace wordgaze::core
