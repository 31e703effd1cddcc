// Vectors of two modes beside a slow roll, from the frequency response in closed form.
#include "signal/resonance_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace whirl_twin {
namespace resonance_fit_test {

using Complex = std::complex<double>;

Complex mode(double speed, double critical, double damping) {
  const double ratio = speed / critical;
  return ratio * ratio / Complex(1.0 - ratio * ratio, 2.0 * damping * ratio);
}

std::vector<SpeedVector> vectors(double noise) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<SpeedVector> all;
  for (double speed = 40.0; speed < 900.0; speed += 7.0) {
    const Complex z = std::polar(4.0e-6, -5.2) +
                      std::polar(2.0e-5, 0.7) * mode(speed, 440.0, 0.045) +
                      std::polar(6.0e-6, -1.9) * mode(speed, 700.0, 0.02);
    all.push_back({speed, z + Complex(normal(random), normal(random))});
  }
  return all;
}

TEST(ResonanceFit, OfTwoModesBesideASlowRoll) {
  const ResonanceFit fit = fitResonances(vectors(0.0));
  ASSERT_EQ(fit.resonances.size(), 2u);
  EXPECT_NEAR(fit.resonances[0].speed, 440.0, 1.0e-4);
  EXPECT_NEAR(fit.resonances[0].damping_ratio, 0.045, 1.0e-7);
  EXPECT_NEAR(fit.resonances[1].speed, 700.0, 1.0e-4);
  EXPECT_NEAR(fit.resonances[1].damping_ratio, 0.02, 1.0e-7);
  EXPECT_NEAR(std::abs(fit.slow_roll - std::polar(4.0e-6, -5.2)), 0.0, 1.0e-11);
  EXPECT_NEAR(fit.resonances[0].amplification_factor(), 11.111, 1.0e-3);
}

TEST(ResonanceFit, DeviationsAreThoseOfTheErrors) {
  const ResonanceFit fit = fitResonances(vectors(4.0e-7));
  ASSERT_EQ(fit.resonances.size(), 2u);
  EXPECT_NEAR(fit.rms, 4.0e-7 * std::sqrt(2.0), 1.0e-7);
  for (const auto& [found, speed, damping] :
       {std::tuple(fit.resonances[0], 440.0, 0.045), std::tuple(fit.resonances[1], 700.0, 0.02)}) {
    EXPECT_LT(std::fabs(found.speed - speed), 3.5 * found.speed_deviation);
    EXPECT_LT(std::fabs(found.damping_ratio - damping), 3.5 * found.damping_ratio_deviation);
    EXPECT_LT(found.speed_deviation, 2.0e-3 * speed);
  }
  EXPECT_LT(std::abs(fit.slow_roll - std::polar(4.0e-6, -5.2)), 5.0 * fit.slow_roll_deviation);
}

TEST(ResonanceFit, WithoutAPeakIsTheSlowRollAlone) {
  std::vector<SpeedVector> flat;
  for (int i = 1; i < 20; ++i) {
    flat.push_back({10.0 * i, {1.0e-6, 2.0e-6}});
  }
  const ResonanceFit fit = fitResonances(flat);
  EXPECT_TRUE(fit.resonances.empty());
  EXPECT_NEAR(std::abs(fit.slow_roll - Complex(1.0e-6, 2.0e-6)), 0.0, 1.0e-12);
}

}  // namespace resonance_fit_test
}  // namespace whirl_twin
