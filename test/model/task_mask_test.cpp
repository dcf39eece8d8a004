#include "wordgaze/model/task_mask.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace wordgaze::model {
namespace {

using Bits = std::vector<std::uint8_t>;

std::uint16_t bright(MaskTruth truth, const Bits& completed, const Bits& enabled) {
  babyai::Progress progress;
  for (std::size_t i = 0; i < completed.size(); ++i) {
    progress.add({}, completed[i] != 0, enabled[i] != 0);
  }
  return bright_sub_tasks(truth, progress);
}

TEST(TaskMask, CompletedSilencesOnlyWhatIsDone) {
  EXPECT_EQ(bright(MaskTruth::completed, Bits{0, 0}, Bits{1, 0}), 0b11);
  EXPECT_EQ(bright(MaskTruth::completed, Bits{1, 0}, Bits{0, 1}), 0b10);
}

TEST(TaskMask, NotEnabledSilencesWhatMustWait) {
  EXPECT_EQ(bright(MaskTruth::not_enabled, Bits{0, 0}, Bits{1, 0}), 0b01);
  EXPECT_EQ(bright(MaskTruth::not_enabled, Bits{0, 0}, Bits{1, 1}), 0b11);
}

TEST(TaskMask, CurrentKeepsOneSubTaskBright) {
  EXPECT_EQ(bright(MaskTruth::current, Bits{0, 0}, Bits{1, 1}), 0b01);
  EXPECT_EQ(bright(MaskTruth::current, Bits{0, 0}, Bits{0, 1}), 0b10);
  EXPECT_EQ(bright(MaskTruth::current, Bits{1, 0}, Bits{0, 1}), 0b10);
}

TEST(TaskMask, HasABitForEachOfSixteenSubTasks) {
  const Bits none(16, 0);
  Bits last(16, 0);
  last.back() = 1;
  EXPECT_EQ(bright(MaskTruth::completed, none, last), 0xFFFF);
  EXPECT_EQ(bright(MaskTruth::current, none, last), 0x8000);
  EXPECT_TRUE(is_bright(15, 0x8000));
}

TEST(TaskMask, JoiningWordsAreDark) {
  EXPECT_FALSE(is_bright(-1, 0b1));
  EXPECT_TRUE(is_bright(1, 0b10));
  EXPECT_FALSE(is_bright(0, 0b10));
}

}  // namespace
}  // namespace wordgaze::model
