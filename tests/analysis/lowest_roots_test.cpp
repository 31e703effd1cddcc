// The lowest eigenvalues of long rotors against the complete dense solution in extended precision.
#include "analysis/lowest_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "all_eigenvalues.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/unstable_root_bound.h"
#include "random_shafts.h"

namespace whirl_twin {
namespace lowest_roots_test {

using Complex = std::complex<double>;

TEST(LowestRoots, AreThoseOfTheDenseSolutionAndNoneThatGrowsIsAmongTheOmitted) {
  int proved = 0;
  int growing = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const RandomShaft drawn = randomShaft(seed, 14 + static_cast<int>(seed % 4));
    const RotorAssembly rotor(drawn.shaft);
    const std::vector<Complex> all = allEigenvalues(rotor.matrices(drawn.speed));
    const BandedLinearization l = rotor.bandedMatrices(drawn.speed);
    const auto roots = lowestRoots(pencilOf(l), 12);
    ASSERT_TRUE(roots) << "seed " << seed;
    std::vector<Complex> values;
    for (const RefinedEigenpair& root : roots->roots) {
      values.push_back(root.value);
    }
    EXPECT_GE(values.size(), 12u);
    EXPECT_EQ(static_cast<std::ptrdiff_t>(values.size()),
              std::count_if(all.begin(), all.end(),
                            [&](const Complex& s) { return std::abs(s) < roots->radius; }))
        << "seed " << seed;
    EXPECT_LE(worstDifference(values, all), 1.0e-9) << "seed " << seed;

    const auto lowest = lowestEigenvalues(l, 6);
    ASSERT_TRUE(lowest) << "seed " << seed;
    EXPECT_LE(worstDifference(lowest->roots, all), 1.0e-9) << "seed " << seed;
    EXPECT_EQ(lowest->roots.size() + lowest->omitted, all.size());
    const auto grows = [](const Complex& s) { return s.real() > 1.0e-12 * std::abs(s); };
    const auto truly = std::count_if(all.begin(), all.end(), grows);
    const auto found = std::count_if(lowest->roots.begin(), lowest->roots.end(), grows);
    EXPECT_TRUE(found == truly || (found < truly && !lowest->omitted_are_sure)) << "seed " << seed;
    if (const auto radius = unstableRootBound(l)) {
      ++proved;
      for (const Complex& s : all) {
        EXPECT_FALSE(grows(s) && std::abs(s) > *radius) << "seed " << seed << ": " << s;
      }
    }
    growing += truly > 0 ? 1 : 0;
  }
  EXPECT_GE(proved, 25);
  EXPECT_GE(growing, 10);
}

// Twice each, forward and backward: a method of single vectors finds one of them.
TEST(LowestRoots, OfARoundShaftAtRestComeInPairs) {
  RandomShaft round = randomShaft(1, 30);
  for (RotorBearing& bearing : round.shaft.bearings) {
    bearing.coefficients = {};
    bearing.coefficients.kxx = bearing.coefficients.kyy = 1.0e7;
  }
  round.shaft.internal_damping = 0.0;
  const auto lowest = lowestEigenvalues(RotorAssembly(round.shaft).bandedMatrices(0.0), 10);
  ASSERT_TRUE(lowest);
  ASSERT_GE(lowest->roots.size(), 20u);
  EXPECT_TRUE(lowest->undamped);
  for (std::size_t i = 0; i + 3 < lowest->roots.size(); i += 4) {
    const double frequency = std::abs(lowest->roots[i]);
    EXPECT_EQ(lowest->roots[i].real(), 0.0);
    EXPECT_NEAR(std::abs(lowest->roots[i + 3]), frequency, 1.0e-10 * frequency);
  }
}

TEST(LowestRoots, WithinACircleAreAllThatLieThere) {
  const RandomShaft drawn = randomShaft(3, 16);
  const RotorAssembly rotor(drawn.shaft);
  const std::vector<Complex> all = allEigenvalues(rotor.matrices(drawn.speed));
  for (const std::size_t count : {0u, 3u, 9u}) {
    const double radius = count == 0 ? 0.5 * std::abs(all[0]) : 1.0001 * std::abs(all[count]);
    const auto found = rootsWithin(pencilOf(rotor.bandedMatrices(drawn.speed)), radius);
    ASSERT_TRUE(found);
    EXPECT_GE(found->radius, radius);
    EXPECT_EQ(static_cast<std::ptrdiff_t>(found->roots.size()),
              std::count_if(all.begin(), all.end(),
                            [&](const Complex& s) { return std::abs(s) < found->radius; }));
  }
}

/// One disc on springs along x and y.
BandedLinearization disc(double damping, double circulatory) {
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d turn;
  turn << 0.0, circulatory, -circulatory, 0.0;
  return banded({2.0 * unit, damping * unit, 0.0 * unit, 800.0 * unit, turn});
}

TEST(GrowthRadius, OfCrossCouplingIsItsPartOfTheDamping) {
  EXPECT_NEAR(unstableRootBound(disc(3.0, 45.0)).value(), 15.0, 0.15);
  EXPECT_GE(unstableRootBound(disc(3.0, 45.0)).value(), 15.0);
  EXPECT_EQ(unstableRootBound(disc(3.0, 0.0)), 0.0);
  EXPECT_EQ(unstableRootBound(disc(0.0, 0.0)), 0.0);
  EXPECT_FALSE(unstableRootBound(disc(0.0, 45.0))) << "nothing bounds what nothing damps";
  EXPECT_FALSE(unstableRootBound(disc(-3.0, 0.0)));
}

TEST(GrowthRadius, OfRotatingDampingIsTheSpeedOfTheShaft) {
  FlexibleShaft shaft = randomShaft(5, 40).shaft;
  shaft.internal_damping = 1.0e-5;
  for (RotorBearing& bearing : shaft.bearings) {
    bearing.coefficients = {};
    bearing.coefficients.kxx = bearing.coefficients.kyy = 1.0e7;
  }
  EXPECT_NEAR(unstableRootBound(RotorAssembly(shaft).bandedMatrices(700.0)).value(), 700.0, 8.0);
}

}  // namespace lowest_roots_test
}  // namespace whirl_twin
