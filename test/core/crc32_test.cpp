#include "wordgaze/core/crc32.hpp"

#include <gtest/gtest.h>

namespace wordgaze {
namespace {

TEST(Crc32, AgreesWithTheStandardsCheckValue) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);
  EXPECT_EQ(crc32(""), 0u);
}

TEST(Crc32, ContinuesOverPieces) { EXPECT_EQ(crc32("6789", crc32("12345")), crc32("123456789")); }

}  // namespace
}  // namespace wordgaze
