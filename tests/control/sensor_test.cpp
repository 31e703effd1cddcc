// Sensors: reproducible noise, an exact filter, clipping, resolution; pulses of a keyphasor.
#include "control/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "control/keyphasor.h"

namespace whirl_twin {
namespace sensor_test {

constexpr double kTwoPi = 6.283185307179586;

TEST(CounterNoise, IsStandardNormalAndWithoutCorrelation) {
  const CounterNoise noise(7, 3);
  const CounterNoise other(7, 4);
  constexpr int kCount = 200000;
  double sum = 0.0, squares = 0.0, fourth = 0.0, next = 0.0, across = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const double x = noise.normal(k);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    next += x * noise.normal(k + 1);
    across += x * other.normal(k);
  }
  // Four standard deviations of each estimate.
  const double root = std::sqrt(double(kCount));
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / root);
  EXPECT_NEAR(squares / kCount, 1.0, 4.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(fourth / kCount, 3.0, 4.0 * std::sqrt(96.0) / root);
  EXPECT_NEAR(next / kCount, 0.0, 4.0 / root);
  EXPECT_NEAR(across / kCount, 0.0, 4.0 / root);
}

TEST(CounterNoise, SampleOfASeedIsTheSameInAnyOrder) {
  const CounterNoise noise(1, 0);
  std::vector<double> forward;
  for (int k = 0; k < 100; ++k) {
    forward.push_back(noise.normal(k));
  }
  for (int k = 99; k >= 0; --k) {
    EXPECT_EQ(CounterNoise(1, 0).normal(k), forward[static_cast<std::size_t>(k)]);
  }
  EXPECT_NE(CounterNoise(2, 0).normal(0), forward[0]);
  EXPECT_NE(noise.normal(std::int64_t{1} << 32), forward[0]);  // the upper word counts
}

/// The sensor's output at the end of n steps of h [s] of a harmonic at w [rad/s].
double afterSteps(Sensor& sensor, double w, double h, int n) {
  sensor.start(0.0);
  double out = 0.0;
  for (int k = 0; k < n; ++k) {
    const double a = k * h;
    const double b = (k + 1) * h;
    const CubicPiece piece{h, std::sin(w * a), std::sin(w * b), w * std::cos(w * a),
                           w * std::cos(w * b)};
    out = sensor.filtered(piece, h);
    sensor.pass(piece);
  }
  return out;
}

TEST(Sensor, FilterHasTheResponseOfOnePole) {
  const double w = 30.0;
  for (const double bandwidth : {0.2, 5.0, 80.0, 1.0e4}) {
    Sensor sensor({0.0, 0.0, 0.0, bandwidth, 0.0}, 1, 0);
    const double pole = kTwoPi * bandwidth;
    const double h = 1.0e-3;
    const int n = 4000;
    const double t = n * h;
    // f' = pole (sin w t - f), f(0) = 0.
    const double scale = pole / (pole * pole + w * w);
    const double expected =
        scale * (pole * std::sin(w * t) - w * std::cos(w * t) + w * std::exp(-pole * t));
    const double cubic_error = std::pow(w * h, 4) / 384.0;  // of the signal itself
    EXPECT_NEAR(afterSteps(sensor, w, h, n), expected, 2.0 * cubic_error) << bandwidth;
  }
}

TEST(Sensor, FilterForgetsHowTheStepsWereCut) {
  const CubicPiece piece{1.0e-2, 1.0, 3.0, -50.0, 200.0};
  for (const double bandwidth : {1.0, 7.9, 8.0, 500.0}) {  // on both sides of the closed form
    Sensor whole({0.0, 0.0, 0.0, bandwidth, 0.0}, 1, 0);
    whole.start(0.3);
    Sensor parts = whole;
    const double middle = 4.0e-3;
    const double h = 1.0e-7;
    const double slope = (piece.at(middle + h) - piece.at(middle - h)) / (2.0 * h);
    parts.pass({middle, piece.from, piece.at(middle), piece.from_rate, slope});
    const CubicPiece rest{piece.length - middle, piece.at(middle), piece.to, slope, piece.to_rate};
    EXPECT_NEAR(parts.filtered(rest, rest.length), whole.filtered(piece, piece.length), 1.0e-8);
  }
}

TEST(Sensor, ClipsBeyondItsRangeAndSaysSo) {
  const Sensor sensor({0.0, 0.25, 2.0, 0.0, 0.0}, 1, 0);
  EXPECT_EQ(sensor.sample(1.1, 0).value, 1.0);
  EXPECT_TRUE(sensor.sample(1.1, 0).valid);
  EXPECT_EQ(sensor.sample(-7.0, 0).value, -2.0);
  EXPECT_FALSE(sensor.sample(-7.0, 0).valid);
  EXPECT_FALSE(sensor.sample(std::nan(""), 0).valid);
}

TEST(Keyphasor, GivesAPulseATurnAtTheMark) {
  const double speed = 157.0;
  const double mark = 1.0;
  const Keyphasor keyphasor({mark, 0.0, 0.0}, 1, 0);
  const auto at = [&](std::int64_t ns) {
    // A billion turns before: no digit of the phase may be lost.
    const double total = speed * static_cast<double>(ns) * 1.0e-9;
    const double turns = std::floor(total / kTwoPi);
    return ShaftInstant{
        ns, {1000000000 + static_cast<std::int64_t>(turns), total - turns * kTwoPi}, speed};
  };
  std::vector<std::int64_t> pulses;
  constexpr std::int64_t kStep = 1000000;
  for (std::int64_t t = 0; t < 1000 * kStep; t += kStep) {
    for (const std::int64_t pulse : keyphasor.pulses(at(t), at(t + kStep))) {
      pulses.push_back(pulse);
    }
  }
  ASSERT_EQ(pulses.size(), 25u);  // (157 - 1) / 2 pi = 24.8
  for (std::size_t k = 0; k < pulses.size(); ++k) {
    EXPECT_NEAR(static_cast<double>(pulses[k]), (mark + kTwoPi * double(k)) / speed * 1.0e9, 2.0);
  }
}

TEST(Keyphasor, BackwardRotationPassesTheMarkToo) {
  const Keyphasor keyphasor({0.5, 0.0, 0.0}, 1, 0);
  const ShaftInstant from{0, {0, 1.0}, -10.0};
  const ShaftInstant to{200000000, {-1, 1.0 - 2.0 + kTwoPi}, -10.0};
  const auto pulses = keyphasor.pulses(from, to);
  ASSERT_EQ(pulses.size(), 1u);
  EXPECT_NEAR(static_cast<double>(pulses[0]), 0.05e9, 2.0);
}

TEST(Keyphasor, ClockStampsWholeTicks) {
  const Keyphasor keyphasor({0.0, 1.0e-4, 1.0e-5}, 1, 0);
  std::set<std::int64_t> offsets;
  for (int k = 0; k < 50; ++k) {
    const ShaftInstant from{k * 100000000LL, {k, 6.0}, 5.0};
    const ShaftInstant to{(k + 1) * 100000000LL, {k + 1, 6.5 - kTwoPi}, 5.0};
    const auto pulses = keyphasor.pulses(from, to);
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_EQ(pulses[0] % 10000, 0);
    offsets.insert(pulses[0] - from.time);
  }
  EXPECT_GT(offsets.size(), 10u);  // jitter of ten ticks
}

}  // namespace sensor_test
}  // namespace whirl_twin
