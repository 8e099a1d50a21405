#include "core/base/triple_buffer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace ostium::core {
namespace {

struct Pair {
  long a = 0, b = 0;
};

TEST(TripleBuffer, GivesTheNewestWholeAndNeverAnOlder) {
  TripleBuffer<Pair> buffer;
  std::thread writer([&] {
    for (long i = 1; i <= 200'000; ++i) {
      buffer.back().a = i, buffer.back().b = -i;
      buffer.publish();
    }
  });
  long last = 0;
  while (last < 200'000)
    if (buffer.update()) {
      const Pair now = buffer.front();
      ASSERT_EQ(now.a, -now.b) << "half of another";
      ASSERT_GT(now.a, last);
      last = now.a;
    }
  writer.join();
  EXPECT_FALSE(buffer.update());
}

TEST(TripleBuffer, TakeGivesTheSameAgainUntilThereIsANewer) {
  TripleBuffer<Pair> buffer({7, -7});
  EXPECT_EQ(buffer.take().a, 7);
  std::atomic<bool> over{false};
  std::thread writer([&] {
    for (long i = 8; i <= 200'000; ++i) buffer.put({i, -i});
    over = true;
  });
  long last = 7;
  while (!over) {
    const Pair p = buffer.take();
    ASSERT_EQ(p.a, -p.b) << "torn";
    ASSERT_GE(p.a, last) << "older than the one before";
    last = p.a;
  }
  writer.join();
  EXPECT_EQ(buffer.take().a, 200'000);
  EXPECT_EQ(buffer.take().a, 200'000);
}

}  // namespace
}  // namespace ostium::core
