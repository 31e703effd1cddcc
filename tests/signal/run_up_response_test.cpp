// Critical speed and amplification factor by the half-power method, for known responses and for
// run-ups through the tracking filter.
#include "signal/run_up_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "known_motion.h"

namespace whirl_twin {
namespace run_up_response_test {

constexpr double kCritical = 100.0;  // [rad/s]

RunUpResponse responseOf(double damping_ratio, bool up = true) {
  RunUpResponse run;
  for (int i = 0; i <= 3000; ++i) {
    const double speed = up ? 20.0 + 0.1 * i : 320.0 - 0.1 * i;
    run.take(0.1 * i, speed, std::abs(quasiStaticResponse(speed, kCritical, damping_ratio, 1e-4)));
  }
  return run;
}

// Exact for a Jeffcott rotor: peak at p / sqrt(1 - 2 D^2), half power in closed form.
TEST(RunUpResponse, HasTheExactFactorsOfAJeffcottRotor) {
  const struct {
    double damping_ratio, factor;
  } kExact[] = {{0.01, 49.980}, {0.05, 9.8996}, {0.1, 4.7969}, {0.2, 2.0726}};
  for (const auto& exact : kExact) {
    for (const bool up : {true, false}) {
      const auto peaks = responseOf(exact.damping_ratio, up).peaks();
      ASSERT_EQ(peaks.size(), 1u);
      const double d = exact.damping_ratio;
      EXPECT_NEAR(peaks[0].speed, kCritical / std::sqrt(1.0 - 2.0 * d * d), 0.01);
      EXPECT_NEAR(peaks[0].time, up ? peaks[0].speed - 20.0 : 320.0 - peaks[0].speed, 0.1);
      ASSERT_TRUE(peaks[0].amplification_factor);
      EXPECT_NEAR(*peaks[0].amplification_factor, exact.factor, 2e-3 * exact.factor);
      EXPECT_LT(*peaks[0].lower, *peaks[0].upper);
    }
  }
}

TEST(RunUpResponse, WithoutASecondHalfPowerPointThereIsNoFactor) {
  const auto peaks = responseOf(0.5).peaks();  // N2 is nowhere beyond D = 0.383
  for (const ResponsePeak& peak : peaks) {
    EXPECT_FALSE(peak.amplification_factor);
  }
}

TEST(RunUpResponse, SaysWhenThePassageIsTooFastForTheFactorToBeTheRotors) {
  for (const double acceleration : {1.0, 30.0}) {
    RunUpResponse run;
    for (int i = 0; i <= 3000; ++i) {
      const double speed = 20.0 + 0.1 * i;
      run.take(0.1 * i / acceleration, speed,
               std::abs(quasiStaticResponse(speed, kCritical, 0.05, 1e-4)));
    }
    ASSERT_EQ(run.peaks().size(), 1u);
    EXPECT_EQ(run.peaks()[0].slow, acceleration == 1.0);  // N2 - N1 = 10 rad/s
    EXPECT_NEAR(run.peaks()[0].acceleration, acceleration, 1e-6);
  }
}

TEST(RunUpResponse, ASpeedTurnsBackByMoreThanAFiftiethOfTheSpan) {
  RunUpResponse run;
  EXPECT_FALSE(run.turnsBack(10.0)) << "there is none yet";
  for (int i = 0; i <= 100; ++i) {
    run.take(0.1 * i, 20.0 + i, 1.0 + std::fabs(i - 40.0));
  }
  EXPECT_FALSE(run.turnsBack(118.5));
  EXPECT_TRUE(run.turnsBack(117.5));
  EXPECT_FALSE(run.turnsBack(150.0));
}

TEST(RunUpResponse, TwoPeaksAreTwoAndARippleOnOneIsNone) {
  RunUpResponse run;
  for (int i = 0; i <= 3000; ++i) {
    const double speed = 20.0 + 0.1 * i;
    const double ripple = 1.0 + 0.01 * std::sin(3.0 * speed);
    run.take(i, speed,
             ripple * (std::abs(quasiStaticResponse(speed, 80.0, 0.03, 1e-4)) +
                       std::abs(quasiStaticResponse(speed, 200.0, 0.03, 1e-4))));
  }
  int whole = 0;
  for (const ResponsePeak& peak : run.peaks()) {
    whole += peak.amplification_factor ? 1 : 0;
  }
  EXPECT_EQ(whole, 2);
}

/// End to end: probes, tracking filter, half power.
TEST(RunUpResponse, OfARunUpThroughTheTrackingFilter) {
  KnownMotion motion;
  motion.speed = 40.0;
  motion.acceleration = 2.0;
  motion.noise = 1e-6;
  motion.z = [](double, double angle, double speed) {
    return Complex(0.0, -1e-3) +
           quasiStaticResponse(speed, kCritical, 0.05, 2e-5) * std::polar(1.0, angle);
  };
  OrderFilter filter;
  RunUpResponse run;
  for (double t = 0.05; t < 60.0; t += 0.05) {
    motion.feed(filter, t, t - 0.05 + 1e-3);
    const OrbitEstimate e = filter.estimate();
    if (e.valid) {
      run.take(e.time, e.speed, std::abs(e.orders[0].alongX()));
    }
  }
  std::vector<ResponsePeak> whole;
  for (const ResponsePeak& peak : run.peaks()) {
    if (peak.amplification_factor) {
      whole.push_back(peak);
    }
  }
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_NEAR(whole[0].speed, kCritical / std::sqrt(1.0 - 2.0 * 0.0025), 0.3);
  EXPECT_NEAR(*whole[0].amplification_factor, 9.8996, 0.1);
  EXPECT_TRUE(whole[0].slow);
}

}  // namespace run_up_response_test
}  // namespace whirl_twin
