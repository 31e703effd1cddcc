#include "realtime/timing_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "allocation_guard.h"

namespace whirl_twin {
namespace timing_histogram_test {

// The percentile by its definition (nearest rank), from all samples sorted.
std::int64_t nearestRank(std::vector<std::int64_t> samples, double percent) {
  std::sort(samples.begin(), samples.end());
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(samples.size()));
  return samples[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

TEST(TimingHistogram, EmptyIsZeroThroughout) {
  const TimingHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.overflow(), 0U);
  EXPECT_EQ(histogram.min(), 0);
  EXPECT_EQ(histogram.max(), 0);
  EXPECT_EQ(histogram.percentile(50.0), 0);
}

TEST(TimingHistogram, ShortDurationsAreExact) {
  for (std::int64_t duration = 0; duration < 64; ++duration) {
    TimingHistogram histogram;
    histogram.add(duration);
    histogram.add(1'000'000);
    EXPECT_EQ(histogram.percentile(50.0), duration);
  }
}

// Every power of two and its neighbours: the places where a bucket could be off by one.
TEST(TimingHistogram, APercentileIsNeverTooShortAndAtMostAThirtySecondTooLong) {
  for (int bits = 0; bits < 34; ++bits) {
    for (const std::int64_t offset : {-1, 0, 1, 2}) {
      const std::int64_t duration = (std::int64_t{1} << bits) + offset;
      if (duration < 0) {
        continue;
      }
      TimingHistogram histogram;
      histogram.add(duration);
      histogram.add(TimingHistogram::kOverflow - 1);
      const std::int64_t found = histogram.percentile(50.0);
      EXPECT_GE(found, duration);
      EXPECT_LE(found, duration + duration / 32);
    }
  }
}

// Realistic latencies: most around 20 us, a tail of three decades.
TEST(TimingHistogram, PercentilesAgreeWithTheSortedSamples) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> latency(std::log(20e3), 1.2);
  for (const std::size_t size : {1U, 2U, 3U, 10U, 1000U, 20'000U}) {
    TimingHistogram histogram;
    std::vector<std::int64_t> samples;
    for (std::size_t i = 0; i < size; ++i) {
      samples.push_back(static_cast<std::int64_t>(latency(random)));
      histogram.add(samples.back());
    }
    EXPECT_EQ(histogram.count(), size);
    EXPECT_EQ(histogram.min(), *std::min_element(samples.begin(), samples.end()));
    EXPECT_EQ(histogram.max(), *std::max_element(samples.begin(), samples.end()));
    EXPECT_NEAR(
        histogram.mean(),
        std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size()),
        1e-9 * histogram.mean());
    EXPECT_EQ(histogram.percentile(100.0), histogram.max());
    std::int64_t before = 0;
    for (const double percent : {0.0, 1.0, 25.0, 50.0, 90.0, 99.0, 99.9, 100.0}) {
      const std::int64_t exact = nearestRank(samples, percent);
      const std::int64_t found = histogram.percentile(percent);
      EXPECT_GE(found, exact) << percent << " % of " << size;
      EXPECT_LE(found, exact + exact / 32) << percent << " % of " << size;
      EXPECT_GE(found, before) << "percentiles do not fall";
      before = found;
    }
  }
}

TEST(TimingHistogram, WhatIsTooLongIsCountedInTheOverflowBinAndItsLengthKept) {
  TimingHistogram histogram;
  histogram.add(TimingHistogram::kOverflow - 1);
  EXPECT_EQ(histogram.overflow(), 0U);
  histogram.add(TimingHistogram::kOverflow);
  histogram.add(3 * TimingHistogram::kOverflow);
  EXPECT_EQ(histogram.overflow(), 2U);
  EXPECT_EQ(histogram.count(), 3U);
  EXPECT_EQ(histogram.max(), 3 * TimingHistogram::kOverflow);
  EXPECT_EQ(histogram.percentile(99.0), 3 * TimingHistogram::kOverflow);
}

TEST(TimingHistogram, ANegativeDurationCountsAsZero) {
  TimingHistogram histogram;
  histogram.add(-5);
  EXPECT_EQ(histogram.count(), 1U);
  EXPECT_EQ(histogram.min(), 0);
  EXPECT_EQ(histogram.max(), 0);
}

TEST(TimingHistogram, ResetForgetsAndTheNextSampleIsBothExtremes) {
  TimingHistogram histogram;
  histogram.add(10);
  histogram.add(TimingHistogram::kOverflow);
  histogram.reset();
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.overflow(), 0U);
  EXPECT_EQ(histogram.max(), 0);
  histogram.add(500);
  EXPECT_EQ(histogram.min(), 500);
  EXPECT_EQ(histogram.max(), 500);
  EXPECT_EQ(histogram.percentile(50.0), 500);
}

TEST(TimingHistogram, ACopyIsIndependent) {
  TimingHistogram histogram;
  histogram.add(100);
  TimingHistogram copy = histogram;
  histogram.add(300);
  EXPECT_EQ(copy.count(), 1U);
  EXPECT_EQ(copy.max(), 100);
  copy = histogram;
  EXPECT_EQ(copy.count(), 2U);
  EXPECT_EQ(copy.min(), 100);
  EXPECT_EQ(copy.percentile(100.0), 300);
}

TEST(TimingHistogram, NeverAllocates) {
  const AllocationGuard guard;
  TimingHistogram histogram;
  histogram.add(100);
  histogram.add(TimingHistogram::kOverflow);
  const TimingHistogram copy = histogram;
  histogram.reset();
  EXPECT_EQ(copy.percentile(50.0), 100 + 1);  // the bucket holds 100 and 101
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace timing_histogram_test
}  // namespace whirl_twin
