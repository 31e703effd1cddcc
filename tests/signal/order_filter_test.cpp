// The tracking filter on motions with known components.
#include "signal/order_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "known_motion.h"

namespace whirl_twin {
namespace order_filter_test {

void expectVector(const Complex& found, const Complex& truth, double part, double angle) {
  EXPECT_NEAR(std::abs(found), std::abs(truth), part * std::abs(truth));
  EXPECT_LT(std::fabs(std::arg(found / truth)), angle);
}

TEST(OrderFilter, TellsForwardBackwardOrdersAndTheMeanApartToRounding) {
  const Complex forward1 = std::polar(3e-4, -0.7), backward1 = std::polar(1e-4, 2.0);
  const Complex forward2 = std::polar(2e-5, 1.0), backward2 = std::polar(5e-6, -2.5);
  KnownMotion motion;
  motion.z = [&](double, double angle, double) {
    return Complex(2e-5, -1e-3) + forward1 * std::polar(1.0, angle) +
           backward1 * std::polar(1.0, -angle) + forward2 * std::polar(1.0, 2.0 * angle) +
           backward2 * std::polar(1.0, -2.0 * angle);
  };
  OrderFilter filter;
  motion.feed(filter, 5.0);
  const OrbitEstimate e = filter.estimate();
  ASSERT_TRUE(e.valid);
  ASSERT_EQ(e.orders.size(), 2u);
  EXPECT_LT(std::abs(e.orders[0].forward - forward1), 1e-15);
  EXPECT_LT(std::abs(e.orders[0].backward - backward1), 1e-15);
  EXPECT_LT(std::abs(e.orders[1].forward - forward2), 1e-15);
  EXPECT_LT(std::abs(e.orders[1].backward - backward2), 1e-15);
  EXPECT_LT(std::abs(e.mean - Complex(2e-5, -1e-3)), 1e-15);
  EXPECT_DOUBLE_EQ(e.speed, 60.0);
  EXPECT_NEAR(e.orders[0].forwardLag(), 0.7, 1e-10);
  EXPECT_NEAR(e.orders[0].major(), 4e-4, 1e-14);
  EXPECT_NEAR(e.orders[0].minor(), 2e-4, 1e-14);
  EXPECT_TRUE(e.lines.empty());
  EXPECT_GT(e.precession, 0.5);
}

// A corrupt count or time stamp: the filter continues, and finds the orders again.
TEST(OrderFilter, IsNotHeldUpByACountThatJumps) {
  const Complex forward = std::polar(1e-4, -0.7);
  KnownMotion motion;
  motion.z = [&](double, double angle, double) { return forward * std::polar(1.0, angle); };
  motion.step = 1.0e-4;
  OrderFilter filter;
  motion.feed(filter, 0.1);
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  for (std::int64_t i = 1001; i < 30000; ++i) {
    OrbitSample sample = motion.sample(i);
    sample.index += kFar;
    filter.take(sample);
  }
  const OrbitEstimate e = filter.estimate();
  ASSERT_TRUE(e.valid);
  EXPECT_LT(std::abs(e.orders[0].forward - forward), 1e-12);
}

/// Through a resonance of amplification factor 5 and on, at 20 rad/s^2.
TEST(OrderFilter, FollowsARunUpAt20RadPerSecondSquaredToATenthOfAPercentAndOfADegree) {
  constexpr double kCritical = 100.0, kDamping = 0.1;
  KnownMotion motion;
  motion.speed = 10.0;
  motion.acceleration = 20.0;
  const auto response = [](double speed) {
    return quasiStaticResponse(speed, kCritical, kDamping, 1e-4);
  };
  motion.z = [&](double, double angle, double speed) {
    return Complex(0.0, -3e-4) + response(speed) * std::polar(1.0, angle) +
           0.2 * response(speed) * std::polar(1.0, -angle) + 2e-5 * std::polar(1.0, 2.0 * angle);
  };
  OrderFilter filter;
  int estimates = 0;
  for (double t = 0.1; t < 12.0; t += 0.1) {
    motion.feed(filter, t, t - 0.1 + 1e-3);
    const OrbitEstimate e = filter.estimate();
    if (!e.valid) {
      continue;
    }
    ++estimates;
    SCOPED_TRACE(e.speed);
    EXPECT_NEAR(e.speed, motion.speedAt(e.time), 1e-9);
    expectVector(e.orders[0].forward, response(e.speed), 1e-3, 0.1 * kDegree);
    expectVector(e.orders[0].backward, 0.2 * response(e.speed), 2e-3, 0.2 * kDegree);
    EXPECT_LT(e.delay, 1.0);
  }
  EXPECT_GT(estimates, 100);
}

TEST(OrderFilter, NoiseGoesIntoTheVectorAsTheDeviationSays) {
  KnownMotion motion;
  motion.noise = 3e-6;
  motion.z = [](double, double angle, double) { return std::polar(5e-5, angle - 1.0); };
  double squares = 0.0, said = 0.0;
  constexpr int kRuns = 60;
  OrderFilter filter;
  for (int i = 0; i < kRuns; ++i) {
    // Two seconds between estimates: other noise in each window.
    const double from = 2.0 * i;
    std::mt19937_64 random(static_cast<unsigned>(i));
    std::normal_distribution<double> normal;
    for (auto k = std::llround(from / motion.step); k < std::llround((from + 2.0) / motion.step);
         ++k) {
      filter.take(motion.sample(k, motion.noise * Complex(normal(random), normal(random))));
    }
    const OrbitEstimate e = filter.estimate();
    squares += std::norm(e.orders[0].forward - std::polar(5e-5, -1.0)) / (2.0 * kRuns);
    said += e.orders[0].deviation / kRuns;
    EXPECT_TRUE(e.lines.empty()) << "a line is made of noise";
  }
  EXPECT_NEAR(std::sqrt(squares) / said, 1.0, 0.3);
  EXPECT_LT(said, 3e-7);
}

TEST(OrderFilter, OilWhirlIsALineAndLeavesTheFirstOrderAlone) {
  KnownMotion motion;
  motion.speed = 200.0;
  motion.z = [](double t, double angle, double) {
    return Complex(0.0, -1e-3) + std::polar(1e-5, angle - 2.0) +
           std::polar(1e-4 * std::exp(0.3 * t), 0.48 * 200.0 * t + 0.3);
  };
  OrderFilter filter;
  motion.feed(filter, 3.0);
  const OrbitEstimate e = filter.estimate();
  ASSERT_TRUE(e.valid);
  expectVector(e.orders[0].forward, std::polar(1e-5, -2.0), 1e-3, 0.1 * kDegree);
  ASSERT_EQ(e.lines.size(), 1u);
  EXPECT_NEAR(e.lines[0].frequency, 96.0, 1e-3);
  EXPECT_NEAR(e.lines[0].forward, 1e-4 * std::exp(0.3 * e.time), 1e-8);
  EXPECT_LT(e.lines[0].backward, 1e-8);
  EXPECT_NEAR(e.lines[0].growth, 0.3, 1e-3);
  EXPECT_GT(e.precession, 0.9);
}

TEST(OrderFilter, WhipThatGrowsInARunUpKeepsItsFrequency) {
  KnownMotion motion;
  motion.speed = 150.0;
  motion.acceleration = 50.0;
  motion.z = [](double t, double angle, double) {
    return std::polar(1e-5, angle - 2.0) + std::polar(1e-5 * std::exp(t), 99.0 * t);
  };
  OrderFilter filter;
  motion.feed(filter, 2.5);
  const OrbitEstimate e = filter.estimate();
  ASSERT_TRUE(e.valid);
  ASSERT_FALSE(e.lines.empty());
  EXPECT_NEAR(e.lines[0].frequency, 99.0, 0.01);
  EXPECT_NEAR(e.lines[0].growth, 1.0, 0.02);
  expectVector(e.orders[0].forward, std::polar(1e-5, -2.0), 5e-3, 0.3 * kDegree);
}

TEST(OrderFilter, PrecessionIsThatOfTheMotionNotOfTheSagOrTheFirstOrder) {
  KnownMotion motion;
  motion.speed = 100.0;
  motion.z = [](double t, double angle, double) {
    return Complex(0.0, -1e-3) + std::polar(1e-5, angle) + std::polar(1e-4, -70.0 * t);
  };
  OrderFilter backward;
  motion.feed(backward, 2.0);
  EXPECT_LT(backward.estimate().precession, -0.8);

  // A shaft that turns the other way makes the same motion a forward one.
  motion.speed = -100.0;
  OrderFilter forward;
  motion.feed(forward, 2.0);
  const OrbitEstimate e = forward.estimate();
  ASSERT_TRUE(e.valid);
  EXPECT_GT(e.precession, 0.8);
  EXPECT_NEAR(std::abs(e.orders[0].forward), 1e-5, 1e-8);
}

TEST(OrderFilter, FreeVibrationAfterAKnockIsNoFirstOrder) {
  KnownMotion motion;
  motion.speed = 40.0;
  motion.z = [](double t, double angle, double) {
    return std::polar(1e-5, angle - 0.2) +
           std::exp(-0.5 * t) * (std::polar(1e-4, 60.0 * t) + std::polar(8e-5, -60.0 * t));
  };
  OrderFilter filter;
  for (double t = 0.25; t < 4.0; t += 0.25) {
    motion.feed(filter, t, t - 0.25 + 1e-3);
    const OrbitEstimate e = filter.estimate();
    if (t > 1.5) {
      SCOPED_TRACE(t);
      expectVector(e.orders[0].forward, std::polar(1e-5, -0.2), 1e-3, 0.1 * kDegree);
      ASSERT_EQ(e.lines.size(), 1u);
      EXPECT_NEAR(e.lines[0].frequency, 60.0, 0.01);
      EXPECT_NEAR(e.lines[0].growth, -0.5, 0.01);
      EXPECT_NEAR(e.lines[0].forward, 1e-4 * std::exp(-0.5 * e.time), 1e-7);
      EXPECT_NEAR(e.lines[0].backward, 8e-5 * std::exp(-0.5 * e.time), 1e-7);
    }
  }
}

TEST(OrderFilter, FollowsAnyOrderAskedFor) {
  KnownMotion motion;
  motion.acceleration = 5.0;
  motion.z = [](double, double angle, double) {
    return std::polar(1e-5, angle) + std::polar(2e-5, 3.0 * angle + 0.3) +
           std::polar(3e-5, -0.5 * angle - 1.2);
  };
  OrderFilter filter({1.0, 3.0, 0.5});
  for (double t = 0.5; t < 4.0; t += 0.07) {
    motion.feed(filter, t, t == 0.5 ? 0.0 : t - 0.07 + 1e-3);
    if (t > 1.0) {
      const OrbitEstimate e = filter.estimate();
      ASSERT_EQ(e.orders.size(), 3u);
      EXPECT_EQ(e.orders[2].order, 0.5);
      expectVector(e.orders[0].forward, 1e-5, 1e-9, 1e-9);
      expectVector(e.orders[1].forward, std::polar(2e-5, 0.3), 1e-9, 1e-9);
      expectVector(e.orders[2].backward, std::polar(3e-5, -1.2), 1e-9, 1e-9);
    }
  }
}

TEST(OrderFilter, LostSamplesAndAResetAreSeen) {
  KnownMotion motion;
  motion.z = [](double t, double angle, double) {
    return std::polar(1e-4, angle) + std::polar(5e-5, 27.0 * t);
  };
  OrderFilter filter;
  for (std::int64_t i = 0; i < 4000; ++i) {
    if (i % 11 != 3 && (i < 3500 || i > 3563)) {
      filter.take(motion.sample(i));
    }
  }
  OrbitEstimate e = filter.estimate();
  expectVector(e.orders[0].forward, 1e-4, 1e-6, 1e-6);
  ASSERT_EQ(e.lines.size(), 1u);
  EXPECT_NEAR(e.lines[0].frequency, 27.0, 1e-3);
  filter.take(motion.sample(0));
  e = filter.estimate();
  EXPECT_FALSE(e.valid);
}

TEST(OrderFilter, AShaftAtRestHasNoOrdersButAMeanAndLines) {
  KnownMotion motion;
  motion.speed = 0.0;
  motion.z = [](double t, double, double) {
    return Complex(1e-4, 2e-4) + std::polar(1e-5, 60.0 * t);
  };
  OrderFilter filter;
  motion.feed(filter, 3.0);
  const OrbitEstimate e = filter.estimate();
  EXPECT_FALSE(e.valid);
  EXPECT_TRUE(e.orders.empty());
  EXPECT_LT(std::abs(e.mean - Complex(1e-4, 2e-4)), 1e-12);
  ASSERT_EQ(e.lines.size(), 1u);
  EXPECT_NEAR(e.lines[0].forward, 1e-5, 1e-9);
  EXPECT_NEAR(e.peak_to_peak, 2e-5, 1e-7);
}

TEST(OrderFilter, SlowRollIsTakenAway) {
  OrderVector whole, slow_roll;
  whole.forward = Complex(3e-5, 1e-5);
  slow_roll.forward = Complex(1e-5, 1e-5);
  whole.backward = slow_roll.backward = Complex(0.0, 2e-6);
  const OrderVector rest = without(whole, slow_roll);
  EXPECT_DOUBLE_EQ(rest.forwardLag(), 0.0);
  EXPECT_NEAR(rest.major(), 2e-5, 1e-20);
  EXPECT_EQ(rest.minor(), rest.major());  // a circle
}

TEST(OrderVector, ProbesSeeWhatTheMotionIs) {
  OrderVector v;
  v.forward = std::polar(3e-5, 0.4);
  v.backward = std::polar(1e-5, -1.1);
  for (double angle = 0.0; angle < 6.0; angle += 0.5) {
    const Complex z = v.forward * std::polar(1.0, angle) + v.backward * std::polar(1.0, -angle);
    EXPECT_NEAR((v.alongX() * std::polar(1.0, angle)).real(), z.real(), 1e-19);
    EXPECT_NEAR((v.alongY() * std::polar(1.0, angle)).real(), z.imag(), 1e-19);
  }
}

}  // namespace order_filter_test
}  // namespace whirl_twin
