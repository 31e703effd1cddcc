#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimation/clock_offset_estimator.h"

namespace whirl_twin {
namespace clock_watch_test {

constexpr std::int64_t kEpoch = 1'750'000'000'000'000'000;  // ns

/// The plant's clock is `offset` [s] ahead at first and gains `drift`; messages take 1 ms and, most
/// of them, some more.
ClockOffsetEstimator watched(double offset, double drift, std::int64_t machine_epoch,
                             double duration) {
  ClockOffsetEstimator watch;
  std::mt19937 random(5);
  std::exponential_distribution<double> delay(1.0 / 0.004);
  for (double t = 0.0; t < duration; t += 0.05) {
    const double machine = offset + t * (1.0 + drift);
    watch.take(machine_epoch + std::llround(machine * 1.0e9),
               kEpoch + std::llround((t + 0.001 + delay(random)) * 1.0e9));
  }
  return watch;
}

TEST(ClockOffsetEstimator, TellsOffsetAndDriftThroughDelays) {
  const ClockOffsetEstimator watch = watched(0.25, 1.0e-4, kEpoch, 100.0);
  EXPECT_NEAR(watch.drift(), 1.0e-4, 1.0e-5);
  EXPECT_NEAR(watch.offset(), 0.25 + 1.0e-4 * 97.0 - 0.001, 1.0e-3);
  EXPECT_LT(watch.deviation(), 1.0e-3);
}

TEST(ClockOffsetEstimator, ClocksThatCountFromElsewhereAreComparedWithTheirStart) {
  const ClockOffsetEstimator watch = watched(0.0, -2.0e-3, 0, 60.0);
  EXPECT_NEAR(watch.offset(), -2.0e-3 * 52.5, 1.0e-2);  // of the last whole window, 50 to 55 s
  EXPECT_NEAR(watch.drift(), -2.0e-3, 1.0e-4);
}

/// A clock that counts from its own start was restarted; one with the time of day was set.
TEST(ClockOffsetEstimator, AMachineThatIsStartedAgainHasAClockOfItsOwn) {
  for (const std::int64_t epoch : {std::int64_t{0}, kEpoch}) {
    ClockOffsetEstimator watch;
    for (int k = 0; k < 4000; ++k) {
      if (k == 2000) {
        watch.restart();
      }
      watch.take(epoch + std::llround(0.01 * (k % 2000) * 1.0e9),
                 kEpoch + std::llround(0.01 * k * 1.0e9));
    }
    EXPECT_NEAR(watch.offset(), epoch == 0 ? 0.0 : -20.0, 1.0e-6);
  }
}

/// A busy machine, where all messages of some seconds are late: no clock gains.
TEST(ClockOffsetEstimator, DelaysThatComeAndGoAreNoDrift) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    ClockOffsetEstimator watch;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> late(0.0, 0.03);
    double delay = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double t = 0.05 * k;
      delay = k % 80 == 0 ? late(random) : delay;
      watch.take(kEpoch + std::llround(t * 1.0e9), kEpoch + std::llround((t + delay) * 1.0e9));
      EXPECT_FALSE(std::fabs(watch.drift()) > 5.0e-4) << seed << " after " << t << " s";
    }
    EXPECT_LT(std::fabs(watch.offset()), 0.03);
  }
}

TEST(ClockOffsetEstimator, SaysNothingBeforeItKnows) {
  const ClockOffsetEstimator watch = watched(0.0, 0.0, kEpoch, 4.0);
  EXPECT_TRUE(std::isnan(watch.offset()));
  EXPECT_TRUE(std::isnan(watch.drift()));
  EXPECT_TRUE(std::isnan(watch.deviation()));
}

}  // namespace clock_watch_test
}  // namespace whirl_twin
