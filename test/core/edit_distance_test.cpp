#include "wordgaze/core/edit_distance.hpp"

#include <gtest/gtest.h>

#include <string>

namespace wordgaze {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
}

TEST(EditDistance, CountsTheRestOfALongTextInFull) {
  const std::string novel(5'000'000, 'a');
  EXPECT_EQ(edit_distance(novel, "aaa"), novel.size() - 3);
  EXPECT_EQ(edit_distance("aaa", novel), novel.size() - 3);
  EXPECT_GE(edit_distance(novel, novel), novel.size());
}

}  // namespace
}  // namespace wordgaze
