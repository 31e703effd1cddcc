// Innovations of a right model are rejected at the specified rate; those of a wrong one at once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "allocation_guard.h"
#include "control/sensor.h"
#include "estimation/alarm_limits.h"
#include "estimation/innovation_tests.h"

namespace whirl_twin {
namespace residual_watch_test {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Counted {
  int windows = 0, mismatched = 0, coloured = 0;
};

/// Two channels of innovations for so many seconds at 100 Hz: `size` times normal numbers, with the
/// autoregressive coefficient `memory`.
Counted run(InnovationTest& watch, double seconds, double size = 1.0, double memory = 0.0) {
  const CounterNoise noise(7, 0);
  Counted counted;
  std::array<double, 2> e{};
  const auto samples = static_cast<std::int64_t>(100.0 * seconds);
  for (std::int64_t k = 0; k < samples; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double news = size * noise.normal(2 * k + static_cast<std::int64_t>(i));
      e[i] = memory * e[i] + std::sqrt(1.0 - memory * memory) * news;
    }
    if (watch.take(0.01 * static_cast<double>(k), e.data(), 2)) {
      ++counted.windows;
      counted.mismatched += watch.verdict().mismatched() ? 1 : 0;
      counted.coloured += watch.verdict().coloured() ? 1 : 0;
    }
  }
  return counted;
}

TEST(InnovationTest, CallsTheRightModelWrongAsOftenAsAskedFor) {
  // 36 an hour: 1 % of windows of 1 s, half of them to each statistic.
  InnovationTest watch(2, {1.0, 36.0});
  const Counted counted = run(watch, 40000.0);
  ASSERT_NEAR(counted.windows, 40000, 2);
  EXPECT_NEAR(counted.mismatched, 200, 45);  // three standard deviations of a Poisson count
  EXPECT_NEAR(counted.coloured, 200, 45);
}

TEST(InnovationTest, CallsTheRightModelRightForADay) {
  InnovationTest watch(2);
  const Counted counted = run(watch, 86400.0);
  EXPECT_EQ(counted.mismatched, 0);
  EXPECT_EQ(counted.coloured, 0);
}

TEST(InnovationTest, FindsResidualsThatAreTooLargeOrTooSmall) {
  for (const double size : {0.6, 2.0}) {
    InnovationTest watch(2);
    const Counted counted = run(watch, 100.0, size);
    EXPECT_EQ(counted.mismatched, counted.windows) << size;
    EXPECT_EQ(counted.coloured, 0) << size;  // whiteness is of their order, not of their size
  }
}

TEST(InnovationTest, ALongerWindowFindsLess) {
  // 5 % more noise: a tenth more of the mean square, whose standard deviation is a tenth for 200
  // numbers, a hundredth for 24,000.
  InnovationTest shorter(2), longer(2, {120.0, 0.005});
  EXPECT_LT(run(shorter, 1200.0, 1.05).mismatched, 20);
  EXPECT_EQ(run(longer, 1200.0, 1.05).mismatched, 9);
}

TEST(InnovationTest, FindsWhatLasts) {
  InnovationTest watch(2, {10.0, 0.005});
  const Counted counted = run(watch, 200.0, 1.0, 0.3);
  EXPECT_EQ(counted.coloured, counted.windows);
  EXPECT_NEAR(watch.verdict().whiteness, 0.3, 0.07);
}

TEST(InnovationTest, ASilentChannelIsNoInnovationOfZero) {
  InnovationTest watch(2, {1.0, 36.0});
  const CounterNoise noise(3, 1);
  for (std::int64_t k = 0; k < 1000; ++k) {
    const std::array<double, 2> e{noise.normal(k), kNone};
    watch.take(0.01 * static_cast<double>(k), e.data(), 2);
  }
  EXPECT_NEAR(watch.verdict().mismatch, 1.0, 0.4);
  // Of 100 numbers, not of 200.
  EXPECT_NEAR(watch.verdict().mismatch_limit, meanSquareLimit(100, normalLimit(0.01 / 4.0)), 1e-12);
}

TEST(InnovationTest, AWindowOfTooFewNumbersGoesOn) {
  InnovationTest watch(1);
  const CounterNoise noise(3, 2);
  int windows = 0;
  for (std::int64_t k = 0; k < 101; ++k) {  // ten a window of 1 s
    const double e = noise.normal(k);
    windows += watch.take(0.1 * static_cast<double>(k), &e, 1) ? 1 : 0;
  }
  EXPECT_EQ(windows, 2);
}

TEST(InnovationTest, TimeThatGoesBackBeginsAnewAndAPairAcrossIsNone) {
  InnovationTest watch(1);
  double e = 1.0;
  for (int k = 0; k < 90; ++k) {
    watch.take(0.01 * k, &e, 1);
  }
  EXPECT_FALSE(watch.take(0.5, &e, 1));
  EXPECT_FALSE(watch.take(1.0, &e, 1));  // half a window after it began
  EXPECT_TRUE(std::isnan(watch.verdict().time));
}

TEST(InnovationTest, AllocatesNothingForASample) {
  InnovationTest watch(2);
  const AllocationGuard guard;
  run(watch, 10.0);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(AlarmLimits, OfTheNormalDistributionAreItsTails) {
  // Abramowitz & Stegun, table 26.5; 1e-6: 4.753424.
  EXPECT_NEAR(normalLimit(0.5), 0.0, 1e-12);
  EXPECT_NEAR(normalLimit(0.025), 1.959963985, 1e-9);
  EXPECT_NEAR(normalLimit(1e-6), 4.753424309, 1e-9);
}

TEST(AlarmLimits, OfAMeanSquareAreThoseOfChiSquared) {
  // chi-squared tables: of 100 degrees, 1 % above 135.807, 1 % below 70.065.
  const double z = normalLimit(0.01);
  EXPECT_NEAR(meanSquareLimit(100, z), 1.35807, 2e-4);
  EXPECT_NEAR(meanSquareLimit(100, -z), 0.70065, 2e-4);
}

TEST(AlarmLimits, OfACumulativeSumArePassedOnceInItsRunLength) {
  const CounterNoise noise(11, 0);
  // Siegmund's approximation is within a fifth.
  for (const double allowance : {0.3, 0.5, 1.0, 1.5}) {
    const double limit = cumulativeSumLimit(allowance, 1000.0);
    double sum = 0.0;
    int passed = 0;
    constexpr int kNumbers = 2000000;
    for (int k = 0; k < kNumbers; ++k) {
      sum = std::fmax(0.0, sum + noise.normal(k) - allowance);
      if (sum > limit) {
        ++passed;
        sum = 0.0;
      }
    }
    EXPECT_NEAR(static_cast<double>(kNumbers) / passed, 1000.0, 200.0) << allowance;
  }
}

/// The part of the standard deviation that is an allowance may be unused, but no more than that.
TEST(InnovationTest, AnAllowanceThatIsNotTakenIsNoMismatch) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const auto& [size, least] : {std::pair(0.8, 1.0), std::pair(0.3, 0.3 * 0.3 / 0.64)}) {
    InnovationTest watch(1);
    double e = 0.0, surest = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      e = size * normal(random);
      surest = e / 0.8;
      watch.take(0.001 * k, &e, 1, &surest);
    }
    EXPECT_NEAR(watch.verdict().mismatch, least, 0.1 * least);
    EXPECT_EQ(watch.verdict().mismatched(), size < 0.5) << size;
  }
}

}  // namespace residual_watch_test
}  // namespace whirl_twin
