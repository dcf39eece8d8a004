#include "wordgaze/core/nearest.hpp"

#include <gtest/gtest.h>

#include <array>

namespace wordgaze {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
}

TEST(Nearest, IsTheFirstOfTheClosestNames) {
  constexpr std::array<std::string_view, 4> known{"steps", "frames", "frame", "seed"};
  EXPECT_EQ(nearest("framse", known), "frame");
  EXPECT_EQ(nearest("sed", known), "seed");
  EXPECT_EQ(nearest("anything", std::array<std::string_view, 0>{}), "");
}

}  // namespace
}  // namespace wordgaze
