// Pairing of measured modes with those of a model where the frequency alone is ambiguous.
#include "estimation/mode_pairing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace mode_pairing_test {

using Complex = std::complex<double>;
constexpr double kHalfPi = 1.57079632679489661923;

AmbientMode measured(double frequency, const Eigen::Vector2cd& shape) {
  AmbientMode mode;
  mode.frequency = frequency;
  mode.shape = shape;
  return mode;
}

TEST(ModePairing, GoesBySenseAndShapeWhereFrequenciesAreOne) {
  const Eigen::Vector2cd none(0.0, 0.0), together(1.0, 0.9), against(1.0, -0.8);
  const std::vector<SeenMode> model{
      {100.0, together, none}, {100.0, none, together}, {101.0, against, 0.4 * against}};
  const auto pairs =
      pairModes({measured(101.2, Complex(0.0, 1.0) * together), measured(-100.4, together),
                 measured(100.6, against), measured(-101.1, against), measured(160.0, together)},
                model);
  ASSERT_EQ(pairs.size(), 4u);
  const std::size_t expected[] = {0, 1, 2, 2};
  for (const ModePair& pair : pairs) {
    EXPECT_EQ(pair.modelled, expected[pair.measured]);
    EXPECT_NEAR(pair.assurance, 1.0, 1e-12);
  }
}

TEST(ModePairing, MakesTheWholeMotionOfTwoProbesAtAnyAngle) {
  const auto stations = measuredStations({3, 3, 3, 1}, {0.6, 0.62, 2.3, kHalfPi});
  ASSERT_EQ(stations.size(), 2u);
  EXPECT_EQ(stations[0].probe, (std::vector<std::size_t>{1, 2}));  // nearest to a right angle
  const Complex z(0.3, -0.7);
  const auto along = [&](double angle) { return std::real(z * std::polar(1.0, -angle)); };
  EXPECT_LT(std::abs(stations[0].z(along(0.62), along(2.3)) - z), 1e-14);
  EXPECT_FALSE(stations[1].whole());
  EXPECT_LT(std::abs(stations[1].z(along(kHalfPi), 0.0) - Complex(0.0, -0.7)), 1e-14);
}

TEST(ModePairing, SeesOfAModeWhatOneProbeShows) {
  WhirlMode mode;
  mode.eigenvalue = {-1.0, 50.0};
  mode.orbits.emplace_back(Complex(1.0, 0.2), Complex(0.1, -0.6));
  const double angle = 0.7;
  const SeenMode seen = seenMode(mode, measuredStations({0}, {angle}));
  for (const double turned : {0.0, 0.4, 2.0}) {
    const Complex now = std::polar(1.0, turned);
    const double shown =
        std::real((std::cos(angle) * mode.orbits[0].x + std::sin(angle) * mode.orbits[0].y) * now);
    const Complex z = seen.forward[0] * now + seen.backward[0] * std::conj(now);
    EXPECT_LT(std::abs(z - std::polar(shown, angle)), 1e-14);
  }
}

}  // namespace mode_pairing_test
}  // namespace whirl_twin
