#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "signal/outliers.h"

namespace whirl_twin {
namespace wild_samples_test {

constexpr double kRate = 1600.0;  // Hz

std::vector<std::int64_t> wildOf(const std::vector<double>& values) {
  WildSampleDetector detector;
  std::vector<std::int64_t> wild;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (const auto found = detector.take(static_cast<std::int64_t>(i), values[i])) {
      wild.push_back(*found);
    }
  }
  EXPECT_EQ(detector.found(), static_cast<std::int64_t>(wild.size()));
  return wild;
}

std::vector<double> sampled(std::size_t count, const std::function<double(double)>& signal) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = signal(static_cast<double>(i) / kRate);
  }
  return values;
}

/// A run-up from 5 to 205 rad/s in 10 s through a resonance at 120, with noise of 0.3 um.
double runUp(double t) {
  static std::mt19937_64 random(1);
  static std::normal_distribution<double> normal(0.0, 3.0e-7);
  const double speed = 5.0 + 20.0 * t;
  const double amplitude = 3.0e-5 / std::hypot(std::pow(120.0 / speed, 2) - 1.0, 0.1);
  return amplitude * std::cos(5.0 * t + 10.0 * t * t) + normal(random);
}

TEST(WildSamples, OneInAThousandOfARunUpIsFoundAndNothingElse) {
  std::vector<double> values = sampled(16000, runUp);
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> place(100, 990);
  std::normal_distribution<double> size(0.0, 1.0);
  std::vector<std::int64_t> wild;
  for (int i = 0; i < 16; ++i) {
    wild.push_back(1000 * i + place(random));
    const double by = size(random);
    values[static_cast<std::size_t>(wild.back())] += std::copysign(2.0e-3, by) + by;
  }
  EXPECT_EQ(wildOf(values), wild);
}

// Signals of which every sample is meant.
TEST(WildSamples, ASignalHasNone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto quantized = [&](double t) { return 1.0e-3 * std::round(3.0 * std::sin(7.0 * t)); };
  const auto steps = [](double t) { return std::floor(4.0 * t); };
  const auto coarse = [](double t) { return std::cos(2.0 * kRate * t); };  // three samples a period
  const auto begins = [](double t) { return t < 3.0 ? 0.0 : std::sin(40.0 * (t - 3.0)); };
  const auto toggles = [&](double t) { return std::fmod(t * kRate, 97.0) < 1.0 ? 1.0e-6 : 0.0; };
  const auto scratch = [](double t) {  // seen by a probe once a turn of 50 samples
    const double turn = std::fmod(t * kRate, 50.0);
    return 1.0e-5 * std::cos(kRate / 50.0 * 6.283185307179586 * t) + (turn < 1.0 ? 1.0e-3 : 0.0);
  };
  const auto noise = [&](double) { return normal(random); };
  const auto wrapped = [](double t) { return std::remainder(30.0 * t, 6.283185307179586); };
  const auto decay = [](double t) { return std::exp(-5.0 * t) * std::cos(60.0 * t); };
  const std::vector<std::function<double(double)>> signals{
      quantized, steps, coarse, begins, toggles, noise, wrapped, decay, runUp};
  for (std::size_t i = 0; i < signals.size(); ++i) {
    EXPECT_TRUE(wildOf(sampled(16000, signals[i])).empty()) << "signal " << i;
  }
  // Of a scratch the first turns are not known to be one.
  EXPECT_LT(wildOf(sampled(16000, scratch)).size(), 10u);
}

TEST(WildSamples, TwoInARowAreFoundToo) {
  std::vector<double> values = sampled(4000, runUp);
  values[2000] = 1.0;
  values[2001] = -1.0;
  EXPECT_EQ(wildOf(values), (std::vector<std::int64_t>{2000, 2001}));
}

}  // namespace wild_samples_test
}  // namespace whirl_twin
