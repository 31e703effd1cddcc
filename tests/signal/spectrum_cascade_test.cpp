// The cascade of full spectra of motions with known spectral components.
#include "signal/spectrum_cascade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "known_motion.h"

namespace whirl_twin {
namespace spectrum_cascade_test {

SpectrumCascade fed(const KnownMotion& motion, double until, std::int64_t stride = 1) {
  SpectrumCascade cascade;
  for (std::int64_t i = 0; static_cast<double>(i) * motion.step <= until; i += stride) {
    cascade.take(motion.sample(i));
  }
  return cascade;
}

/// Unbalance 20 um, some of it backward, oil whirl at 0.47 of the speed, about a sag.
KnownMotion oilWhirl(double speed, double acceleration) {
  KnownMotion motion;
  motion.speed = speed;
  motion.acceleration = acceleration;
  motion.z = [](double, double angle, double) {
    return Complex(0.0, -1e-3) + std::polar(20e-6, angle) + std::polar(5e-6, -angle) +
           std::polar(8e-6, 0.47 * angle + 0.3);
  };
  return motion;
}

TEST(SpectrumCascade, NamesTheLinesOfASteadyMotion) {
  for (const double direction : {1.0, -1.0}) {
    const auto window = fed(oilWhirl(direction * 200.0, 0.0), 5.0).latest();
    ASSERT_TRUE(window);
    EXPECT_NEAR(window->end - window->begin, 4.0, 0.01);
    ASSERT_EQ(window->lines.size(), 3u);
    EXPECT_EQ(window->lines[0].order, 1);
    EXPECT_NEAR(window->lines[0].frequency, 200.0, 0.02) << "with the rotation";
    EXPECT_NEAR(window->lines[0].amplitude, 20e-6, 0.2e-6);
    EXPECT_FALSE(window->lines[0].subsynchronous());
    EXPECT_EQ(window->lines[1].order, 0);
    EXPECT_TRUE(window->lines[1].subsynchronous());
    EXPECT_NEAR(window->lines[1].ratio, 0.47, 1e-3);
    EXPECT_NEAR(window->lines[1].amplitude, 8e-6, 0.1e-6);
    EXPECT_EQ(window->lines[2].order, 1);
    EXPECT_NEAR(window->lines[2].frequency, -200.0, 0.02) << "against it";
    EXPECT_NEAR(window->lines[2].amplitude, 5e-6, 0.1e-6);
  }
}

TEST(SpectrumCascade, ItsBinsHoldTheLines) {
  const auto window = fed(oilWhirl(200.0, 0.0), 5.0).latest();
  ASSERT_TRUE(window);
  const auto highest = std::max_element(window->amplitude.begin(), window->amplitude.end());
  EXPECT_NEAR(window->frequency(static_cast<std::size_t>(highest - window->amplitude.begin())),
              200.0, 1.01 * window->step);
  EXPECT_NEAR(*highest, 20e-6, 0.5e-6);
  EXPECT_NEAR(window->frequency(0), -kPi / 1e-3, 2.0 * window->step);
}

/// The window is as short as keeps the lines sharp, and they are found at every speed.
TEST(SpectrumCascade, FollowsARunUp) {
  const SpectrumCascade cascade = fed(oilWhirl(60.0, 10.0), 20.0);
  ASSERT_GT(cascade.spectra().size(), 40u);
  for (const WindowSpectrum& spectrum : cascade.spectra()) {
    if (spectrum.begin == 0.0) {
      continue;
    }
    EXPECT_NEAR(spectrum.smear, spectrum.resolution, 0.02 * spectrum.resolution);
    EXPECT_NEAR(spectrum.speed, 60.0 + 5.0 * (spectrum.begin + spectrum.end), 0.1);
    ASSERT_FALSE(spectrum.lines.empty());
    EXPECT_EQ(spectrum.lines[0].order, 1);
    EXPECT_NEAR(spectrum.lines[0].frequency, spectrum.speed, spectrum.resolution);
    if (0.53 * spectrum.speed > 4.0 * spectrum.resolution) {
      const auto slower = std::find_if(spectrum.lines.begin(), spectrum.lines.end(),
                                       [](const SpectrumLine& l) { return l.subsynchronous(); });
      ASSERT_NE(slower, spectrum.lines.end()) << spectrum.speed;
      EXPECT_NEAR(slower->ratio, 0.47, 0.05);
    }
  }
}

TEST(SpectrumCascade, KeepsAFewHoweverLongItLasts) {
  const SpectrumCascade cascade = fed(oilWhirl(100.0, 0.0), 200.0, 5);
  EXPECT_GE(cascade.spectra().size(), 48u);
  EXPECT_LT(cascade.spectra().size(), 96u);
  const double apart = cascade.spectra()[1].end - cascade.spectra()[0].end;
  for (std::size_t i = 1; i < cascade.spectra().size(); ++i) {
    EXPECT_NEAR(cascade.spectra()[i].end - cascade.spectra()[i - 1].end, apart,
                0.02 * apart + 0.01);
  }
  EXPECT_GT(cascade.spectra().back().end, 190.0);
}

TEST(SpectrumCascade, SamplesThatAreTooFarApartSeeNoShaftTurn) {
  EXPECT_TRUE(fed(oilWhirl(100.0, 0.0), 20.0, 20).latest()) << "3.1 samples a turn";
  EXPECT_FALSE(fed(oilWhirl(100.0, 0.0), 20.0, 30).latest()) << "2.1 samples a turn";
}

TEST(SpectrumCascade, AHoleBeginsANewWindowAndAResetANewCascade) {
  const KnownMotion motion = oilWhirl(200.0, 0.0);
  SpectrumCascade cascade = fed(motion, 6.0);
  const std::size_t before = cascade.spectra().size();
  cascade.take(motion.sample(6100));
  EXPECT_FALSE(cascade.latest()) << "a line across the hole would be none of the motion";
  EXPECT_EQ(cascade.spectra().size(), before);
  for (std::int64_t i = 0; i < 1100; ++i) {
    cascade.take(motion.sample(i));
  }
  ASSERT_EQ(cascade.spectra().size(), 1u);
  EXPECT_LT(cascade.spectra()[0].end, 1.1);
}

TEST(SpectrumCascade, NoiseHasNoLines) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1e-6);
  SpectrumCascade cascade;
  for (std::int64_t i = 0; i < 20000; ++i) {
    cascade.take({i, 1e-3 * static_cast<double>(i), 0, 0.0, 100.0, normal(random), normal(random)});
  }
  std::size_t lines = 0;
  for (const WindowSpectrum& spectrum : cascade.spectra()) {
    lines += spectrum.lines.size();
  }
  EXPECT_LT(lines, cascade.spectra().size() / 4);
}

}  // namespace spectrum_cascade_test
}  // namespace whirl_twin
