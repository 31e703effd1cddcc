// The newest record is read whole, once, and in order, with any timing of the two threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

#include "allocation_guard.h"
#include "realtime/record_ring.h"

namespace whirl_twin {
namespace latest_record_test {

void publish(LatestRecord& latest, double value, std::size_t size) {
  std::fill_n(latest.room(), size, value);
  latest.publish();
}

TEST(LatestRecord, GivesTheNewestAndThatOnce) {
  LatestRecord latest(3);
  std::vector<double> record(3, -1.0);
  EXPECT_FALSE(latest.take(record.data())) << "nothing yet";
  EXPECT_EQ(record, std::vector<double>(3, -1.0));
  publish(latest, 1.0, 3);
  publish(latest, 2.0, 3);
  publish(latest, 3.0, 3);
  EXPECT_TRUE(latest.take(record.data()));
  EXPECT_EQ(record, std::vector<double>(3, 3.0));
  EXPECT_FALSE(latest.take(record.data()));
  publish(latest, 4.0, 3);
  EXPECT_TRUE(latest.take(record.data()));
  EXPECT_EQ(record, std::vector<double>(3, 4.0));
}

// A torn record would have two values in it; a reader that fell back would see a smaller one.
TEST(LatestRecord, StaysWholeBetweenTwoThreads) {
  constexpr std::size_t kSize = 64;
  constexpr int kRecords = 200000;
  LatestRecord latest(kSize);
  std::uint64_t allocations = 1;
  std::thread producer([&] {
    const AllocationGuard guard;
    for (int i = 1; i <= kRecords; ++i) {
      publish(latest, i, kSize);
    }
    allocations = guard.allocations();
  });
  std::vector<double> record(kSize);
  double last = 0.0;
  int torn = 0;
  int backward = 0;
  while (last < kRecords) {
    if (latest.take(record.data())) {
      torn += record != std::vector<double>(kSize, record[0]);
      backward += record[0] <= last;
      last = record[0];
    }
  }
  producer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backward, 0);
  EXPECT_EQ(allocations, 0u);
}

}  // namespace latest_record_test
}  // namespace whirl_twin
