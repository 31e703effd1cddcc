// The full spectrum of known motions.
#include "signal/full_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "known_motion.h"

namespace whirl_twin {
namespace full_spectrum_test {

constexpr double kPeriod = 1.0e-3;  // [s]

Eigen::ArrayXcd sampled(Eigen::Index n, const std::function<Complex(double)>& z) {
  Eigen::ArrayXcd samples(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    samples[i] = z(static_cast<double>(i) * kPeriod);
  }
  return samples;
}

const auto kAny = [](double) { return true; };

TEST(FullSpectrum, ACircleIsOneLineOfItsRadiusOnTheSideOfItsSense) {
  for (const double frequency : {137.3, -137.3, 50.0, -2000.1}) {
    const FullSpectrum spectrum(
        sampled(1500, [&](double t) { return std::polar(2e-5, frequency * t + 0.4); }), kPeriod);
    const auto peak = spectrum.highest(kAny);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(peak->frequency, frequency, 0.02 * spectrum.resolution());
    EXPECT_NEAR(peak->amplitude, 2e-5, 0.02e-5);
    EXPECT_NEAR(spectrum.precession(1.0), frequency > 0.0 ? 1.0 : -1.0, 0.02);
    EXPECT_NEAR(spectrum.precession(-1.0), frequency > 0.0 ? -1.0 : 1.0, 0.02);
  }
}

// An orbit on a line is two circles of half its amplitude, which sweep nothing.
TEST(FullSpectrum, AStraightOrbitIsForwardAndBackwardAlike) {
  const FullSpectrum spectrum(sampled(2048, [](double t) { return 4e-5 * std::cos(100.0 * t); }),
                              kPeriod);
  const auto forward = spectrum.highest([](double w) { return w > 0.0; });
  const auto backward = spectrum.highest([](double w) { return w < 0.0; });
  ASSERT_TRUE(forward && backward);
  EXPECT_NEAR(forward->amplitude, 2e-5, 1e-7);
  EXPECT_NEAR(backward->amplitude, 2e-5, 1e-7);
  EXPECT_NEAR(spectrum.precession(1.0), 0.0, 1e-6);
}

TEST(FullSpectrum, WhiteNoiseHasNoProminentLine) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int prominent = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const FullSpectrum spectrum(
        sampled(512, [&](double) { return Complex(normal(random), normal(random)); }), kPeriod);
    prominent += spectrum.highest(kAny)->prominence > 12.0 ? 1 : 0;
  }
  EXPECT_LE(prominent, 5);
}

TEST(FullSpectrum, FrequenciesRiseFromMinusNyquist) {
  const FullSpectrum spectrum(sampled(100, [](double) { return 1.0; }), kPeriod);
  EXPECT_EQ(spectrum.size(), 256u);
  EXPECT_NEAR(spectrum.frequency(0), -kPi / kPeriod, 1e-9);
  EXPECT_EQ(spectrum.frequency(128), 0.0);
  EXPECT_NEAR(spectrum.amplitude(128), 1.0, 1e-12);
}

}  // namespace full_spectrum_test
}  // namespace whirl_twin
