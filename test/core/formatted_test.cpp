#include "wordgaze/core/formatted.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace wordgaze {
namespace {

TEST(Formatted, PutsEachValueInItsPlace) {
  const std::string name = "Two";
  EXPECT_EQ(formatted("'{}' has {} of {}{}", name, 3, std::string_view("12"), '!'),
            "'Two' has 3 of 12!");
  EXPECT_EQ(formatted("{}", "a literal"), "a literal");
  EXPECT_EQ(formatted("nothing to fill in"), "nothing to fill in");
  EXPECT_EQ(formatted("{}", "{}"), "{}");
}

TEST(Formatted, WritesNumbersAsNumbersWhateverTheirType) {
  EXPECT_EQ(formatted("{} {}", std::uint8_t{65}, std::int8_t{-1}), "65 -1");
  EXPECT_EQ(formatted("{}", std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(formatted("{} {}", true, false), "true false");
}

TEST(Formatted, WritesTheShortestDigitsThatReadAsTheSameNumber) {
  EXPECT_EQ(formatted("{} {} {}", 0.1, 0.1f, 2.0), "0.1 0.1 2");
  EXPECT_EQ(formatted("{}", 1.0 / 3), "0.3333333333333333");
}

TEST(Shortened, LeavesShortTextsAlone) {
  EXPECT_EQ(shortened("abc"), "abc");
  EXPECT_EQ(shortened(std::string(1'000'000, 'x'), 6), "xxx... (1000000 characters)");
}

}  // namespace
}  // namespace wordgaze
