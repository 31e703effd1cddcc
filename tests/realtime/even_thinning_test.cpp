#include "realtime/even_thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace whirl_twin {
namespace even_thinning_test {

constexpr std::size_t kCapacity = 1000;

/// A ring that is filled while its consumer works: each record costs `look` to inspect, and those
/// that are used `take` more, in units of the period of the records.
struct Consumer {
  double look;
  double take;
  EvenThinning thinning{kCapacity};
  double waiting = 0.0;
  std::int64_t step = 0;
  std::int64_t dropped = 0;
  std::vector<std::int64_t> taken{};

  void consume(std::int64_t records) {
    for (std::int64_t i = 0; i < records; ++i) {
      const bool takes = step % thinning.every() == 0;
      if (takes) {
        taken.push_back(step);
      }
      ++step;
      waiting = std::max(0.0, waiting + look + (takes ? take : 0.0) - 1.0);
      if (waiting > kCapacity) {
        dropped += static_cast<std::int64_t>(waiting) - static_cast<std::int64_t>(kCapacity);
        waiting = kCapacity;
      }
      thinning.consumed(static_cast<std::size_t>(waiting));
    }
  }
};

TEST(EvenThinning, TakesEveryRecordOfWhatItKeepsUpWith) {
  Consumer consumer{0.1, 0.8};
  consumer.consume(100'000);
  EXPECT_EQ(consumer.thinning.every(), 1);
  EXPECT_EQ(consumer.taken.size(), 100'000u);
}

TEST(EvenThinning, LeavesOutEvenlyAndNoMoreThanItMust) {
  Consumer consumer{0.1, 5.0};  // keeps up with one of six at most: one of eight
  consumer.consume(20'000);
  const std::size_t settled = consumer.taken.size();
  const std::int64_t dropped = consumer.dropped;
  consumer.consume(200'000);
  EXPECT_EQ(consumer.dropped, dropped) << "the ring never fills again";
  for (std::size_t i = settled + 1; i < consumer.taken.size(); ++i) {
    const std::int64_t gap = consumer.taken[i] - consumer.taken[i - 1];
    EXPECT_GE(gap, 1);
    EXPECT_LE(gap, 16) << "after step " << consumer.taken[i - 1];
  }
  EXPECT_GT(consumer.taken.size() - settled, 200'000u / 10);
}

TEST(EvenThinning, TakesAllAgainWhenItKeepsUp) {
  Consumer consumer{0.1, 20.0};
  consumer.consume(50'000);
  EXPECT_GT(consumer.thinning.every(), 8);
  consumer.take = 0.5;
  consumer.consume(100'000);
  EXPECT_EQ(consumer.thinning.every(), 1);
}

TEST(EvenThinning, StaysBelowABoundWhateverHappens) {
  Consumer consumer{2.0, 5.0};
  consumer.consume(1'000'000);
  EXPECT_EQ(consumer.thinning.every(), 4096);
}

}  // namespace even_thinning_test
}  // namespace whirl_twin
