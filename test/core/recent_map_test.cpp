#include "wordgaze/core/recent_map.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace wordgaze {
namespace {

TEST(RecentMap, LetsTheLongestUnaskedMakeRoom) {
  RecentMap<int, std::string> map(2);
  EXPECT_FALSE(map.put(1, "a"));
  EXPECT_FALSE(map.put(2, "b"));
  ASSERT_NE(map.find(1), nullptr);  // now 2 is the one
  const auto evicted = map.put(3, "c");
  ASSERT_TRUE(evicted);
  EXPECT_EQ(evicted->first, 2);
  EXPECT_EQ(evicted->second, "b");
  EXPECT_EQ(map.find(2), nullptr);
  EXPECT_EQ(*map.find(1), "a");
  EXPECT_EQ(*map.find(3), "c");
}

TEST(RecentMap, PutsAnotherValueIntoAPlaceThatIsThere) {
  RecentMap<int, std::string> map(1);
  map.put(1, "a");
  EXPECT_FALSE(map.put(1, "b"));
  EXPECT_EQ(*map.find(1), "b");
  map.erase(1);
  map.erase(1);
  EXPECT_EQ(map.size(), 0u);
  EXPECT_FALSE(map.put(2, "c"));
}

TEST(RecentMap, RefusesToHaveRoomForNone) {
  EXPECT_THROW((RecentMap<int, int>(0)), std::invalid_argument);
}

TEST(RecentMap, IsThatOfAListThatIsSearched) {
  constexpr std::size_t kCapacity = 5;
  RecentMap<int, int> map(kCapacity);
  std::vector<std::pair<int, int>> list;  // the most recent last
  std::mt19937 random(1);
  const auto take = [&](int key) -> std::optional<int> {
    for (auto entry = list.begin(); entry != list.end(); ++entry) {
      if (entry->first != key) continue;
      const int value = entry->second;
      list.erase(entry);
      return value;
    }
    return std::nullopt;
  };
  for (int round = 0; round < 5000; ++round) {
    const int key = static_cast<int>(random() % 9), choice = static_cast<int>(random() % 8);
    if (choice == 0) {
      map.erase(key);
      take(key);
    } else if (choice < 4) {
      const int* found = map.find(key);
      const auto expected = take(key);
      ASSERT_EQ(found != nullptr, expected.has_value());
      if (!expected) continue;
      ASSERT_EQ(*found, *expected);
      list.emplace_back(key, *expected);
    } else {
      const auto evicted = map.put(key, round);
      const bool known = take(key).has_value();
      list.emplace_back(key, round);
      ASSERT_EQ(evicted.has_value(), !known && list.size() > kCapacity);
      if (!evicted) continue;
      ASSERT_EQ((std::pair<int, int>(*evicted)), list.front());
      list.erase(list.begin());
    }
    ASSERT_EQ(map.size(), list.size());
  }
}

}  // namespace
}  // namespace wordgaze
