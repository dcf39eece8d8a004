#include "wordgaze/training/resume.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/messages.hpp"

namespace wordgaze::training {
namespace {

TrainConfig of_frames(std::int64_t frames) {
  TrainConfig config;
  config.frames = frames;
  return config;
}

TEST(Resume, IsOfTheSameRun) {
  TrainConfig before = of_frames(1000), now = before;
  EXPECT_NO_THROW(check_same_run("'a'", before, now));
  now.frames = 2000;
  EXPECT_NO_THROW(check_same_run("'a'", before, now));
  now.ppo.discount = 0;
  now.seed = 9;
  const auto message =
      message_of<std::invalid_argument>([&] { check_same_run("'a'", before, now); });
  for (const char* part : {"'a'", "ppo.discount: 0.99", "seed: 1"}) {
    EXPECT_TRUE(contains(message, part));
  }
}

TEST(Resume, GoesOnAndNotBack) {
  EXPECT_THROW(check_frames(of_frames(3200), of_frames(800), 3200), std::invalid_argument);
  EXPECT_NO_THROW(check_frames(of_frames(3200), of_frames(3200), 3200));
  EXPECT_NO_THROW(check_frames(of_frames(3200), of_frames(5000), 3200));
  // The last update goes beyond the frames that were asked for.
  EXPECT_NO_THROW(check_frames(of_frames(3200), of_frames(3200), 3264));
  // A run that was to be longer may end where it is, or later, but not before.
  EXPECT_NO_THROW(check_frames(of_frames(9000), of_frames(4000), 3200));
  EXPECT_THROW(check_frames(of_frames(9000), of_frames(3000), 3200), std::invalid_argument);
}

TEST(Resume, SaysWhatJumps) {
  EXPECT_EQ(schedule_changes(of_frames(1000), of_frames(1000), 500), "");
  const auto changes = schedule_changes(of_frames(1000), of_frames(100'000), 1000);
  EXPECT_TRUE(contains(changes, "frames = 100000 in place of 1000"));
  EXPECT_TRUE(contains(changes, "the learning rate from 5e-05 to 0.00099"));
  EXPECT_TRUE(contains(changes, "the focus of the gaze from 1 to 0"));
  EXPECT_EQ(changes.find("Task Attention"), std::string::npos);
}

}  // namespace
}  // namespace wordgaze::training
