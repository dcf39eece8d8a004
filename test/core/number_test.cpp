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

TEST(WholeNumberIn, MayHaveAnExponent) {
  EXPECT_EQ(whole_number_in<int>("1e6"), 1'000'000);
  EXPECT_EQ(whole_number_in<std::int64_t>("2.5E9"), 2'500'000'000);
  EXPECT_EQ(whole_number_in<int>("-3e0"), -3);
  EXPECT_EQ(whole_number_in<std::uint64_t>("18446744073709551615"), UINT64_MAX);
  for (const char* text : {"1.5", "2.0", "1.5e0", "1e-3", "1e10", "1e99", "inf", "nan", "e", "1e",
                           "1e6 ", "0x1e6", ""}) {
    EXPECT_EQ(whole_number_in<int>(text), std::nullopt) << '"' << text << '"';
  }
  EXPECT_EQ(whole_number_in<std::uint64_t>("-1e3"), std::nullopt);
}

}  // namespace
}  // namespace wordgaze
