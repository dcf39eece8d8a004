#include "lcm/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace wordgaze::lcm_io {
namespace {

TEST(BoundedQueue, RefusesWhatDoesNotFitAndKeepsTheOrder) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.try_push(1));
  EXPECT_TRUE(queue.try_push(2));
  EXPECT_FALSE(queue.try_push(3));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(queue.try_push(4));
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), 4);
}

TEST(BoundedQueue, GivesOutWhatItHoldsBeforeItEnds) {
  BoundedQueue<int> queue(2);
  queue.try_push(1);
  queue.close();
  EXPECT_FALSE(queue.try_push(2));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, PassesItemsBetweenThreads) {
  BoundedQueue<int> queue(8);
  std::vector<int> received;
  std::thread reader([&] {
    while (const auto item = queue.pop()) received.push_back(*item);
  });
  for (int i = 0; i < 1000; ++i) {
    while (!queue.try_push(i)) std::this_thread::yield();
  }
  queue.close();
  reader.join();
  ASSERT_EQ(received.size(), 1000u);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(received[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace wordgaze::lcm_io
