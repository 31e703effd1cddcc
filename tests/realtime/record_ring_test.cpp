// Output of the real-time loop: records arrive whole and in order, or are counted as dropped.
#include "realtime/record_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "allocation_guard.h"

namespace whirl_twin {
namespace record_ring_test {

constexpr std::size_t kSize =
    7;  // does not divide the ring's length, so records wrap around its end
using Record = std::array<double, kSize>;

// A record that shows if it was torn: every value is fixed by its number.
Record numbered(std::int64_t number) {
  Record record;
  for (std::size_t i = 0; i < kSize; ++i) {
    record[i] = static_cast<double>(number) + static_cast<double>(i) / 8.0;
  }
  return record;
}

TEST(RecordRing, GivesBackWhatItWasGivenInOrder) {
  RecordRing ring(kSize, 4);
  EXPECT_EQ(ring.recordSize(), kSize);
  Record found{};
  EXPECT_FALSE(ring.pop(found.data()));
  for (int round = 0; round < 50; ++round) {  // many times around the ring
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(ring.push(numbered(3 * round + i).data()));
    }
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(ring.pop(found.data()));
      ASSERT_EQ(found, numbered(3 * round + i));
    }
  }
  EXPECT_FALSE(ring.pop(found.data()));
  EXPECT_EQ(ring.dropped(), 0U);
}

TEST(RecordRing, HoldsItsCapacityAndDropsAndCountsTheRest) {
  RecordRing ring(kSize, 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.push(numbered(i).data()));
  }
  EXPECT_FALSE(ring.push(numbered(4).data()));
  EXPECT_FALSE(ring.push(numbered(5).data()));
  EXPECT_EQ(ring.dropped(), 2U);
  Record found{};
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.pop(found.data()));
    EXPECT_EQ(found, numbered(i));  // the oldest are kept, whole
  }
  EXPECT_FALSE(ring.pop(found.data()));
}

TEST(RecordRing, NothingIsLostOrTornBetweenTwoThreadsWhenItIsDrained) {
  constexpr std::int64_t kRecords = 50'000;
  RecordRing ring(kSize, 16);
  std::thread producer([&ring] {
    for (std::int64_t i = 0; i < kRecords; ++i) {
      while (!ring.push(numbered(i).data())) {
        std::this_thread::yield();
      }
    }
  });
  std::int64_t whole = 0;
  Record found{};
  for (std::int64_t expected = 0; expected < kRecords;) {
    if (ring.pop(found.data())) {
      whole += found == numbered(expected) ? 1 : 0;
      ++expected;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_EQ(whole, kRecords);
  EXPECT_FALSE(ring.pop(found.data()));
}

// A producer that never waits: records arrive in order and whole, and the numbers of those that
// arrived, were dropped and were pushed agree.
TEST(RecordRing, EveryRecordEitherArrivesOrIsCountedAsDropped) {
  constexpr std::int64_t kRecords = 50'000;
  RecordRing ring(kSize, 8);
  std::atomic<bool> done{false};
  std::int64_t accepted_sum = 0;
  std::uint64_t accepted = 0;
  std::thread producer([&] {
    for (std::int64_t i = 0; i < kRecords; ++i) {
      if (ring.push(numbered(i).data())) {
        accepted_sum += i;
        ++accepted;
      }
    }
    done = true;
  });
  std::int64_t received_sum = 0;
  std::uint64_t received = 0;
  std::int64_t last = -1;
  bool in_order_and_whole = true;
  Record found{};
  for (bool last_round = false; !last_round;) {
    last_round = done;  // read before draining, so that nothing remains
    while (ring.pop(found.data())) {
      const auto number = static_cast<std::int64_t>(found[0]);
      in_order_and_whole = in_order_and_whole && number > last && found == numbered(number);
      last = number;
      received_sum += number;
      ++received;
    }
  }
  producer.join();
  EXPECT_TRUE(in_order_and_whole);
  EXPECT_EQ(received, accepted);
  EXPECT_EQ(received_sum, accepted_sum);
  EXPECT_EQ(received + ring.dropped(), static_cast<std::uint64_t>(kRecords));
}

TEST(RecordRing, ASizeOfZeroIsRefused) {
  EXPECT_THROW(RecordRing(0, 4), std::logic_error);
  EXPECT_THROW(RecordRing(4, 0), std::logic_error);
  EXPECT_THROW(RecordRing(std::size_t{1} << 40, std::size_t{1} << 40), std::logic_error);
}

TEST(RecordRing, PushAndPopDoNotAllocate) {
  RecordRing ring(kSize, 4);
  Record record = numbered(1);
  const AllocationGuard guard;
  for (int i = 0; i < 10; ++i) {
    ring.push(record.data());
  }
  while (ring.pop(record.data())) {
  }
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace record_ring_test
}  // namespace whirl_twin
