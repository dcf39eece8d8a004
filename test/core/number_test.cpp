#include "wordgaze/core/number.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace wordgaze {
namespace {

TEST(NumberIn, ReadsWholeNumbersOfItsType) {
  EXPECT_EQ(number_in<int>("0"), 0);
  EXPECT_EQ(number_in<int>("-12"), -12);
  EXPECT_EQ(number_in<std::uint64_t>("18446744073709551615"), UINT64_MAX);
  EXPECT_EQ(number_in<double>("-1e3"), -1000);
}

TEST(NumberIn, ReadsNothingElse) {
  for (const char* text : {"", " ", "1 ", " 1", "1 x", "+1", "0x10", "1.5", "one", "--1", "1\n"}) {
    EXPECT_EQ(number_in<int>(text), std::nullopt) << '"' << text << '"';
  }
  EXPECT_EQ(number_in<std::uint64_t>("-1"), std::nullopt);
  EXPECT_EQ(number_in<std::uint64_t>("18446744073709551616"), std::nullopt);
  EXPECT_EQ(number_in<int>(std::string(1'000'000, '9')), std::nullopt);
}

}  // namespace
}  // namespace wordgaze
