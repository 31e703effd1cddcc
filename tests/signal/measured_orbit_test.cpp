#include "signal/measured_orbit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "signal/order_filter.h"

namespace whirl_twin {
namespace measured_orbit_test {

constexpr double kTurn = ShaftAngle::kTurn;
constexpr double kRate = 2000.0;  // Hz
constexpr double kSpeed = 130.0;  // [rad/s]
constexpr std::int64_t kPeriod = 500'000;
constexpr std::int64_t kBlock = 200;  // samples

std::complex<double> orbit(double t) {
  const double angle = kSpeed * t;
  return 2.0e-5 + std::polar(5.0e-5, angle - 0.7) + std::polar(1.0e-5, -angle - 0.2);
}

/// A pair of probes along these directions, and a keyphasor at angle 0.
MeasuredOrbitSettings probePair(double first, double second) {
  return {{{{"probes", "a", first}, {"probes", "b", second}}}, "tacho", {0.0, 1.0e-7, 1.0}, 0.5};
}

state::Measurement probeBlock(std::int64_t block, double first, double second) {
  state::Measurement message;
  message.source = "probes";
  message.channel = {"a", "other", "b"};
  message.unit = {"m", "rad", "um"};
  message.samples = kBlock;
  message.first_instant = block * kBlock * kPeriod;
  message.period = kPeriod;
  for (std::int64_t i = 0; i < kBlock; ++i) {
    const std::complex<double> z = orbit(static_cast<double>(block * kBlock + i) / kRate);
    const auto along = [&](double a) { return z.real() * std::cos(a) + z.imag() * std::sin(a); };
    message.value.insert(message.value.end(), {along(first), 1.0e9, 1.0e6 * along(second)});
    message.valid.insert(message.valid.end(), {1, 0, 1});
  }
  return message;
}

/// Pulses of a tenth of a second.
state::Measurement pulseBlock(std::int64_t block) {
  state::Measurement message;
  message.source = "tacho";
  message.channel = {"keyphasor"};
  message.unit = {"-"};
  const double length = static_cast<double>(kBlock) / kRate, turn = kTurn / kSpeed;
  const double from = length * static_cast<double>(block), to = from + length;
  for (double k = std::ceil(from / turn); k * turn < to; k += 1.0) {
    message.instant.push_back(std::llround(k * turn * 1.0e9));
    message.value.push_back(1.0);
    message.valid.push_back(1);
  }
  message.samples = static_cast<std::int64_t>(message.instant.size());
  message.first_instant = message.instant.empty() ? 0 : message.instant.front();
  return message;
}

void expectTheOrbit(const std::vector<OrbitSample>& samples, double from) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const OrbitSample& s = samples[i];
    const std::complex<double> z = orbit(s.time);
    ASSERT_NEAR(s.x, z.real(), 1.0e-12);
    ASSERT_NEAR(s.y, z.imag(), 1.0e-12);
    if (i > 0) {
      ASSERT_GT(s.time, samples[i - 1].time);
      ASSERT_EQ(s.index - samples[i - 1].index,
                std::llround((s.time - samples[i - 1].time) * kRate));
    }
    if (s.time >= from) {
      ASSERT_NEAR(s.speed, kSpeed, 1.0e-2);
      ASSERT_NEAR(std::remainder(s.remainder - kSpeed * s.time, kTurn), 0.0, 1.0e-5) << s.time;
    }
  }
}

TEST(MeasuredOrbit, GivesTheOrbitOfProbesInAnyDirections) {
  constexpr double kHalfPi = 0.25 * kTurn;
  const std::vector<std::pair<double, double>> directions = {
      {0.0, kHalfPi}, {0.5 * kHalfPi, 1.5 * kHalfPi}, {kHalfPi, 0.0}, {0.3, 1.1}, {-2.0, 2.5}};
  for (const auto& [first, second] : directions) {
    MeasuredOrbit measured(probePair(first, second));
    std::vector<OrbitSample> samples;
    for (std::int64_t block = 0; block < 10; ++block) {
      measured.take(probeBlock(block, first, second), samples);
      measured.take(pulseBlock(block), samples);
    }
    EXPECT_GE(samples.size(), 10u * kBlock - kBlock);
    expectTheOrbit(samples, 0.3);
    const std::size_t before = samples.size();
    measured.finish(samples);
    EXPECT_GT(samples.size(), before);
    EXPECT_EQ(samples.size(), 10u * kBlock);
    expectTheOrbit(samples, 0.3);
    EXPECT_EQ(measured.samples().used, 2 * 10 * kBlock);
  }
}

TEST(MeasuredOrbit, ItDoesNotMatterWhichMessageComesFirst) {
  MeasuredOrbit measured(probePair(0.3, 1.9));
  std::vector<OrbitSample> samples;
  for (std::int64_t block = 0; block < 10; ++block) {
    for (const std::int64_t pulses : {3 * block, 3 * block + 1, 3 * block + 2}) {
      if (pulses < 10) {
        measured.take(pulseBlock(pulses), samples);  // up to a second ahead
      }
    }
    measured.take(probeBlock(block, 0.3, 1.9), samples);
  }
  expectTheOrbit(samples, 0.3);
  EXPECT_GE(samples.size(), 9u * kBlock);
}

TEST(MeasuredOrbit, OrdersAreThoseOfTheOrbit) {
  MeasuredOrbit measured(probePair(0.785, 2.356));
  OrderFilter filter;
  for (std::int64_t block = 0; block < 40; ++block) {
    std::vector<OrbitSample> samples;
    measured.take(pulseBlock(block), samples);
    measured.take(probeBlock(block, 0.785, 2.356), samples);
    for (const OrbitSample& sample : samples) {
      filter.take(sample);
    }
  }
  const OrbitEstimate estimate = filter.estimate();
  ASSERT_TRUE(estimate.valid);
  EXPECT_NEAR(std::abs(estimate.orders[0].forward), 5.0e-5, 1.0e-9);
  EXPECT_NEAR(estimate.orders[0].forwardLag(), 0.7, 1.0e-4);
  EXPECT_NEAR(std::abs(estimate.orders[0].backward), 1.0e-5, 1.0e-9);
  EXPECT_NEAR(estimate.orders[0].backwardLag(), 0.2, 1.0e-4);
  EXPECT_NEAR(estimate.mean.real(), 2.0e-5, 1.0e-9);
}

TEST(MeasuredOrbit, LeavesOutWhatIsNoSampleAndCountsIt) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  std::vector<OrbitSample> samples;
  for (std::int64_t block = 0; block < 10; ++block) {
    state::Measurement message = probeBlock(block, 0.0, 1.5);
    if (block == 4) {
      message.valid[3 * 10] = 0;
      message.value[3 * 20 + 2] = std::numeric_limits<double>::quiet_NaN();
    }
    if (block == 5) {
      measured.take(probeBlock(2, 0.0, 1.5), samples);  // late
    }
    measured.take(message, samples);
    measured.take(pulseBlock(block), samples);
    if (block == 7) {
      measured.take(message, samples);  // again: all but the last sample are late
    }
  }
  measured.finish(samples);
  expectTheOrbit(samples, 0.3);
  EXPECT_EQ(samples.size(), 10u * kBlock - 2u);
  EXPECT_EQ(measured.samples().invalid, 1);
  EXPECT_EQ(measured.samples().not_finite, 1);
  EXPECT_EQ(measured.samples().alone, 2);
  EXPECT_EQ(measured.samples().late, 2 * kBlock + 2 * (kBlock - 1));
  EXPECT_EQ(measured.samples().repeated, 2);
}

TEST(MeasuredOrbit, AChannelInAUnitThatIsNoLengthIsNotBelieved) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  state::Measurement message = probeBlock(0, 0.0, 1.5);
  message.unit[0] = "rad";
  std::vector<OrbitSample> samples;
  measured.take(message, samples);
  measured.finish(samples);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(measured.samples().invalid, kBlock);
}

TEST(MeasuredOrbit, WaitsForAPulseNoLongerThanItWasTold) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  std::vector<OrbitSample> samples;
  for (std::int64_t block = 0; block < 20; ++block) {
    if (block < 10) {
      measured.take(pulseBlock(block), samples);
    }
    measured.take(probeBlock(block, 0.0, 1.5), samples);
    const double newest = static_cast<double>((block + 1) * kBlock - 1) / kRate;
    if (!samples.empty()) {
      EXPECT_GE(samples.back().time, newest - 0.5 - 2.0 / kRate);
    }
  }
  // Predicted from the last pulse on; not for ever.
  EXPECT_NEAR(samples.back().time, 1.5, 2.0e-3);
  EXPECT_NEAR(samples.back().speed, kSpeed, 0.1);
  for (std::int64_t block = 20; block < 100; ++block) {
    measured.take(probeBlock(block, 0.0, 1.5), samples);
  }
  EXPECT_EQ(samples.back().speed, 0.0);
  EXPECT_NEAR(samples.back().x, orbit(samples.back().time).real(), 1.0e-12);
}

TEST(MeasuredOrbit, WithoutAKeyphasorThereIsAnOrbitButNoSpeed) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  std::vector<OrbitSample> samples;
  for (std::int64_t block = 0; block < 10; ++block) {
    measured.take(probeBlock(block, 0.0, 1.5), samples);
  }
  ASSERT_GT(samples.size(), 4u * kBlock);
  for (const OrbitSample& sample : samples) {
    EXPECT_EQ(sample.speed, 0.0);
  }
}

TEST(MeasuredOrbit, KeepsTimeApartFromTheInstantsOfAClock) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  constexpr std::int64_t kClock = 1'700'000'000'000'000'000;
  state::Measurement message = probeBlock(0, 0.0, 1.5);
  message.first_instant += kClock;
  std::vector<OrbitSample> samples;
  measured.take(message, samples);
  measured.finish(samples);
  ASSERT_EQ(samples.size(), static_cast<std::size_t>(kBlock));
  EXPECT_EQ(measured.origin(), kClock);
  EXPECT_NEAR(samples[7].time, 7.0 / kRate, 1.0e-12);
}

TEST(MeasuredOrbit, BeginsAnewWhenTold) {
  MeasuredOrbit measured(probePair(0.0, 1.5));
  std::vector<OrbitSample> samples;
  for (int run = 0; run < 2; ++run) {
    for (std::int64_t block = 0; block < 10; ++block) {
      measured.take(pulseBlock(block), samples);
      measured.take(probeBlock(block, 0.0, 1.5), samples);
    }
    EXPECT_GE(samples.size(), 9u * kBlock);
    expectTheOrbit(samples, 0.3);
    samples.clear();
    measured.clear();
  }
  EXPECT_EQ(measured.samples().late, 0);
}

TEST(MeasuredOrbit, TwoProbesAlongOneLineAreRefused) {
  EXPECT_THROW(MeasuredOrbit(probePair(0.4, 0.4)), std::invalid_argument);
  EXPECT_THROW(MeasuredOrbit(probePair(0.4, 0.4 + 0.5 * kTurn)), std::invalid_argument);
}

}  // namespace measured_orbit_test
}  // namespace whirl_twin
