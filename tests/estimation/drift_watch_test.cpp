// Constant parameters raise no alarm, whatever the memory of the filter; one that drifts does in
// time, and the alarm reports which, from which value, to which value and since when.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "allocation_guard.h"
#include "control/sensor.h"
#include "estimation/innovation_tests.h"

namespace whirl_twin {
namespace drift_watch_test {

/// A filter at rest that estimates one parameter, and lets it walk: a gain, a memory [s] and a
/// deviation.
class Estimate {
 public:
  Estimate(double deviation, double memory, std::uint32_t seed, double step = 0.1)
      : deviation_(deviation), gain_(1.0 - std::exp(-step / memory)), noise_(seed, 5) {
    // So that the error has P/2: gain r / (2 - gain) = P/2.
    measured_ = deviation * std::sqrt(0.5 * (2.0 - gain_) / gain_);
    error_ = deviation * std::sqrt(0.5) * noise_.normal(0);
  }
  double next(double truth) {
    ++k_;
    if (k_ == 1) {
      value_ = truth + error_;
    }
    value_ += gain_ * (truth + measured_ * noise_.normal(k_) - value_);
    return value_;
  }
  double deviation() const { return deviation_; }

 private:
  double deviation_, gain_;
  CounterNoise noise_;
  double measured_ = 0.0, error_ = 0.0, value_ = 0.0;
  std::int64_t k_ = 0;
};

/// [s] of the first alarm for a constant parameter of value 1, with the given standard deviation;
/// infinite: none within `seconds`.
double firstAlarm(CusumDetector& watch, Estimate& estimate, double deviation, double seconds,
                  double step) {
  for (std::int64_t k = 0; step * static_cast<double>(k) < seconds; ++k) {
    const double time = step * static_cast<double>(k);
    const double value = estimate.next(1.0);
    if (watch.take(time, &value, &deviation) && watch.drift().parameter >= 0) {
      return time;
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(CusumDetector, AlarmsFalselyLessOftenThanAskedFor) {
  // False-alarm rate of one in ten hours, for filters with long and short memory, high and low
  // uncertainty, consistent or overconfident; a hundred runs of two hours with a warm-up each.
  for (const double memory : {0.1, 3.0, 10.0, 60.0}) {
    for (const double deviation : {0.002, 0.05}) {
      for (const double sure : {1.0, 1.4}) {
        int alarms = 0;
        for (std::uint32_t seed = 0; seed < 100; ++seed) {
          CusumDetector watch(1, {1.0, 120.0, 0.02, 0.1});
          Estimate estimate(sure * deviation, memory, seed, 1.0);
          alarms += std::isfinite(firstAlarm(watch, estimate, deviation, 7200.0, 1.0)) ? 1 : 0;
        }
        EXPECT_LE(alarms, 20) << memory << " s, deviation " << deviation << ", too sure by "
                              << sure;
      }
    }
  }
}

TEST(CusumDetector, AlarmsFalselyLessOftenThanAskedForWhereParametersAreEstimatedTogether) {
  // y = a + b u + noise, by a Kalman filter that lets a and b walk; u changes slowly, so that their
  // errors are correlated with each other and along time.
  int alarms = 0;
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const CounterNoise noise(seed, 9);
    CusumDetector watch(2, {1.0, 120.0, 0.02, 0.1});
    Eigen::Vector2d x(1.0, 1.0);
    Eigen::Matrix2d p = 0.01 * Eigen::Matrix2d::Identity();
    bool alarmed = false;
    for (int k = 0; k < 7200; ++k) {
      const Eigen::Vector2d h(1.0, 1.0 + 0.5 * std::sin(0.1 * k));
      p += 1e-6 * Eigen::Matrix2d::Identity();
      const double s = h.dot(p * h) + 1e-3;
      const Eigen::Vector2d gain = p * h / s;
      x += gain * (h.sum() + std::sqrt(1e-3) * noise.normal(k) - h.dot(x));
      p -= gain * gain.transpose() * s;
      const Eigen::Vector2d deviation = p.diagonal().cwiseSqrt();
      watch.take(k, x.data(), deviation.data());
      alarmed = alarmed || watch.drift().parameter >= 0;
    }
    EXPECT_TRUE(watch.learned(0) && watch.learned(1));
    alarms += alarmed ? 1 : 0;
  }
  EXPECT_LE(alarms, 10);
}

struct Found {
  double at = std::numeric_limits<double>::infinity();  // [s] after the drift began
  CusumDetector::Drift drift;
};

/// The stiffness 1.7e7 loses 5 % in 60 s, after half an hour, with a constant mass.
Found drifting(double deviation, double memory, std::uint32_t seed) {
  constexpr double kStiffness = 1.7e7, kBegins = 1800.0;
  CusumDetector watch(2);
  Estimate mass(deviation, memory, 2 * seed), stiffness(deviation, memory, 2 * seed + 1);
  for (std::int64_t k = 0; k < 19000; ++k) {
    const double time = 0.1 * static_cast<double>(k);
    const double lost = 0.05 * std::fmin(std::fmax(0.0, time - kBegins) / 60.0, 1.0);
    const std::array<double, 2> value{2.0 * mass.next(1.0),
                                      kStiffness * stiffness.next(1.0 - lost)};
    const std::array<double, 2> known{2.0 * deviation, kStiffness * deviation};
    if (watch.take(time, value.data(), known.data()) && watch.drift().parameter >= 0) {
      return {time - kBegins, watch.drift()};
    }
  }
  return {};
}

TEST(CusumDetector, FindsFivePercentInAMinuteTenSecondsAfterTwo) {
  for (const auto& [deviation, memory] : {std::pair(0.002, 1.0), std::pair(0.003, 3.0)}) {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
      const Found found = drifting(deviation, memory, seed);
      EXPECT_GT(found.at, 5.0) << seed;
      EXPECT_LT(found.at, 34.0) << seed;  // 2 % are gone after 24 s
      EXPECT_EQ(found.drift.parameter, 1) << seed;
      EXPECT_GT(found.drift.statistic, found.drift.limit) << seed;
      EXPECT_NEAR(found.drift.from, 1.7e7, 0.003 * 1.7e7) << seed;
      EXPECT_LT(found.drift.to, 0.995 * found.drift.from) << seed;
      EXPECT_NEAR(found.drift.since, 1810.0, 15.0) << seed;
    }
  }
}

TEST(CusumDetector, WhatIsKnownBetterLaterIsNoDriftAndANewReference) {
  // Poorly known and frozen, then identified by a run-up: the estimate jumps to the true value. A
  // later loss is detected as soon as the estimate shows it.
  CusumDetector watch(1);
  Estimate good(0.005, 3.0, 1);
  double found = std::numeric_limits<double>::infinity();
  for (std::int64_t k = 0; k < 15000; ++k) {
    const double time = 0.1 * static_cast<double>(k);
    const double measured = good.next(time < 1200.0 ? 1.0 : 0.95);
    const double value = time < 600.0 ? 1.08 : measured;
    const double deviation = time < 600.0 ? 0.1 : 0.005;
    if (watch.take(time, &value, &deviation) && watch.drift().parameter >= 0) {
      found = std::fmin(found, time);
    }
  }
  EXPECT_GT(found, 1200.0);
  EXPECT_LT(found, 1220.0);
}

TEST(CusumDetector, WhatIsKnownWorseLaterMayWander) {
  // A probe fails: the standard deviation is five times as large, and the estimate scatters
  // accordingly.
  CusumDetector watch(1);
  Estimate good(0.004, 1.0, 1), worse(0.02, 25.0, 2);
  for (std::int64_t k = 0; k < 72000; ++k) {
    const double time = 0.1 * static_cast<double>(k);
    const double value = time < 600.0 ? good.next(1.0) : worse.next(1.0);
    const double deviation = time < 600.0 ? 0.004 : 0.02;
    watch.take(time, &value, &deviation);
    ASSERT_EQ(watch.drift().parameter, -1) << time;
  }
}

TEST(CusumDetector, WhatReturnsIsNoDriftAnyMore) {
  CusumDetector watch(1);
  Estimate estimate(0.002, 2.0, 4);
  int alarmed = 0;
  for (std::int64_t k = 0; k < 6000; ++k) {
    const double time = 0.1 * static_cast<double>(k);
    const double value = estimate.next(time >= 300.0 && time < 400.0 ? 1.04 : 1.0);
    const double deviation = estimate.deviation();
    if (watch.take(time, &value, &deviation) && watch.drift().parameter >= 0) {
      ++alarmed;
      EXPECT_GT(time, 300.0);
      EXPECT_LT(time, 420.0);
    }
  }
  EXPECT_GT(alarmed, 90);
}

TEST(CusumDetector, AnEstimateThatIsNoneIsLeftOut) {
  CusumDetector watch(1);
  Estimate estimate(0.002, 2.0, 4);
  for (std::int64_t k = 0; k < 6000; ++k) {
    const double time = 0.1 * static_cast<double>(k);
    const bool none = k > 3000 && k % 70 == 0;
    const double value = none ? std::nan("") : estimate.next(1.0);
    const double deviation =
        k > 3000 && k % 90 == 0 ? std::numeric_limits<double>::infinity() : estimate.deviation();
    watch.take(time, &value, &deviation);
    ASSERT_EQ(watch.drift().parameter, -1) << time;
  }
  EXPECT_TRUE(std::isfinite(watch.drift().statistic));
}

TEST(CusumDetector, AllocatesNothingForASample) {
  CusumDetector watch(1);
  Estimate estimate(0.002, 2.0, 4);
  const AllocationGuard guard;
  firstAlarm(watch, estimate, 0.002, 600.0, 0.1);
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace drift_watch_test
}  // namespace whirl_twin
