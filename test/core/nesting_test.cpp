#include "wordgaze/core/nesting.hpp"

#include <gtest/gtest.h>

#include <string>

namespace wordgaze {
namespace {

TEST(JsonNesting, CountsWhatIsOpen) {
  EXPECT_EQ(json_nesting(R"(3)"), 0);
  EXPECT_EQ(json_nesting(R"({"a":[1,[2]],"b":{}})"), 3);
  EXPECT_EQ(json_nesting(R"([[],[],[]])"), 2);
  EXPECT_EQ(json_nesting(std::string(100'000, '[')), 100'000);
}

TEST(JsonNesting, LeavesTextsOut) {
  EXPECT_EQ(json_nesting(R"({"[[[":"{{{\"[[["})"), 1);
  EXPECT_EQ(json_nesting(R"(["\\",[]])"), 2);
  EXPECT_EQ(json_nesting("\"\\"), 0);
}

}  // namespace
}  // namespace wordgaze
