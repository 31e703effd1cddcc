// Thresholds of instability by formula, by Routh's test and by eigenvalues; the margin against
// cross-coupled stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/bracketed_root.h"
#include "analysis/campbell.h"
#include "analysis/cross_coupling_margin.h"
#include "analysis/instability_speed.h"
#include "analysis/stability.h"
#include "models_under_test.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace rotor_stability_test {

/// The speed at which the rightmost eigenvalue crosses the axis, between two speeds.
double thresholdByEigenvalues(const LinearRotor& rotor, double low, double high) {
  const auto growth = [&](double speed) {
    double rightmost = -1.0e300;
    for (const auto& root : eigenvalues(rotor.matrices(speed))) {
      rightmost = std::max(rightmost, root.real());
    }
    return rightmost;
  };
  return bracketedRoot(growth, low, high, growth(low), growth(high));
}

double threshold(const Dynamics& dynamics) {
  return instabilitySpeed(dynamics, Eigen::VectorXd::Zero(dynamics.dof()), 0.0).value();
}

TEST(Threshold, OfInternalDampingIsTheSameThreeWays) {
  for (const double ratio : {0.5, 2.0, 4.0}) {
    const auto dynamics = dynamicsOf("jeffcott_rotor", {{"mass", 2.0},
                                                        {"stiffness", 180000.0},
                                                        {"damping", 12.0 * ratio},
                                                        {"internal_damping", 12.0}});
    const double formula = 300.0 * (1.0 + ratio);
    EXPECT_NEAR(threshold(*dynamics) / formula, 1.0, 1.0e-12);
    EXPECT_NEAR(thresholdByEigenvalues(dynamics->linearRotor(), 301.0, 3000.0) / formula, 1.0,
                1.0e-10);
  }
}

TEST(Threshold, OfFluidWhirlIsTheSameThreeWays) {
  const auto dynamics = dynamicsOf(
      "jeffcott_rotor",
      {{"mass", 2.0}, {"stiffness", 180000.0}, {"fluid_damping", 40.0}, {"fluid_ratio", 0.48}});
  EXPECT_NEAR(threshold(*dynamics) / (300.0 / 0.48), 1.0, 1.0e-12);
  EXPECT_NEAR(thresholdByEigenvalues(dynamics->linearRotor(), 301.0, 3000.0) / (300.0 / 0.48), 1.0,
              1.0e-10);
}

// Twelve coordinates, beyond the exact test: discs of equal stiffness and mass where external and
// internal damping are both in proportion to the springs' matrix would be Jeffcott rotors, one a
// mode. Here the dampings are C = c K / k, C_i = c_i K / k: threshold p_1 (1 + c / c_i).
TEST(Threshold, OfManyCoordinatesFollowsTheFormulaOfItsLowestMode) {
  const double external = 30.0, internal = 20.0, k = 1.0e6;
  const RotorUnderTest chain = chainRotor(6);
  RotorUnderTest r = chain;
  r.rotor.matrices = [=, base = chain.rotor.matrices(0.0)](double speed) {
    Linearization l = base;
    l.damping = (external + internal) / k * l.stiffness;
    const Eigen::MatrixXd turning = speed * internal / k * l.stiffness.topLeftCorner(6, 6);
    l.circulatory.topRightCorner(6, 6) = turning;
    l.circulatory.bottomLeftCorner(6, 6) = -turning;
    return l;
  };
  r.rotor.speed_dependent = true;
  const auto modes = whirlModes(chain.rotor.matrices(0.0), r.stations);
  const double lowest = std::abs(modes.modes.front().eigenvalue);
  const double undamped = [&] {
    Linearization l = chain.rotor.matrices(0.0);
    l.damping.setZero();
    return whirlModes(l, r.stations).modes.front().dampedFrequency();
  }();
  EXPECT_NEAR(lowest, undamped, 0.05 * undamped);
  const double formula = undamped * (1.0 + external / internal);
  EXPECT_NEAR(threshold(r.dynamics()) / formula, 1.0, 1.0e-9);
  // The branch that crosses whirls forward at its natural frequency.
  const CampbellDiagram diagram =
      campbell(r.rotor, r.stations, {{0.0, 0.5 * formula, 1.001 * formula}});
  EXPECT_LT(diagram.branches[1].back().decay_rate, 0.0);
  EXPECT_EQ(diagram.branches[1].back().whirl, Whirl::kForward);
  EXPECT_NEAR(diagram.branches[1].back().frequency, undamped, 1.0e-3 * undamped);
}

// E01: a Jeffcott rotor bears q = c p.
TEST(CrossCouplingMargin, OfAJeffcottRotorIsDampingTimesFrequency) {
  const auto reference = rotorCase("E01");
  const auto dynamics =
      dynamicsOf("jeffcott_rotor", {{"mass", 2.0}, {"stiffness", 180000.0}, {"damping", 60.0}});
  const LinearRotor rotor = dynamics->linearRotor();
  const auto stations = dynamics->stations();
  EXPECT_NEAR(crossCouplingMargin(rotor, stations, 0, 500.0).value(), 18000.0, 1.0e-6);
  std::vector<double> couplings;
  const auto rows = expectedOf(reference, "eigs_vs_q");
  for (const auto& row : rows) {
    couplings.push_back(row["q"]);
  }
  const auto found = firstForwardMode(rotor, stations, 0, 500.0, couplings);
  ASSERT_EQ(found.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(found[i].mode.eigenvalue.real(), rows[i]["least_stable"][0], 1.0e-8);
    EXPECT_NEAR(found[i].mode.eigenvalue.imag(), rows[i]["least_stable"][1], 1.0e-8);
    EXPECT_NEAR(found[i].mode.logDecrement(), rows[i]["log_dec"], 1.0e-10);
  }
}

TEST(CrossCouplingMargin, MakesTheRotorMarginalAtItsStation) {
  const RotorUnderTest r = chainRotor(5);
  for (const std::size_t station : {0u, 2u}) {
    const double q = crossCouplingMargin(r.rotor, r.stations, station, 100.0).value();
    const auto row = firstForwardMode(r.rotor, r.stations, station, 100.0, {0.5 * q, q});
    EXPECT_GT(row[0].mode.logDecrement(), 0.0);
    EXPECT_NEAR(row[1].mode.logDecrement(), 0.0, 1.0e-9);
  }
}

TEST(CrossCouplingMargin, OfAnUndampedRotorIsZero) {
  const RotorUnderTest r = chainRotor(3, 5.0e5, 1.0, 0.0, 5.0);
  EXPECT_EQ(crossCouplingMargin(r.rotor, r.stations, 0, 5000.0).value(), 0.0);
}

}  // namespace rotor_stability_test

}  // namespace whirl_twin
