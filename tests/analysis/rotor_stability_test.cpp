// Thresholds of instability by formula, by Routh's test and by eigenvalues; the margin against
// cross-coupled stiffness.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "analysis/campbell.h"
#include "analysis/cross_coupling_margin.h"
#include "analysis/instability_speed.h"
#include "analysis/polynomial_roots.h"
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
  const auto found = slowestForwardMode(rotor, stations, 0, 500.0, couplings);
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
    const auto row = slowestForwardMode(r.rotor, r.stations, station, 100.0, {0.5 * q, q});
    EXPECT_GT(row[0].mode.logDecrement(), 0.0);
    EXPECT_NEAR(row[1].mode.logDecrement(), 0.0, 1.0e-9);
  }
}

/// Growth [1/s] of what grows fastest, and of what goes forward at a station the log. decrement
/// where it decays slowest, with damping ratios below 0.7, from all eigenvalues of the state
/// matrix.
struct DenseVerdict {
  double growth = -1.0e300;
  double forward = -1.0e300;
  double decrement = 0.0;
};
DenseVerdict denseVerdict(const Linearization& l, const Station& station) {
  const Eigen::Index n = l.mass.rows();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -l.mass.inverse() * (l.stiffness + l.circulatory);
  a.bottomRightCorner(n, n) = -l.mass.inverse() * (l.damping + l.gyroscopic);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  DenseVerdict verdict;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> s = solver.eigenvalues()[i];
    if (s.imag() <= 0.0 || -s.real() > 0.7 * std::abs(s)) {
      continue;
    }
    const Eigen::VectorXcd shape = solver.eigenvectors().col(i).head(n);
    const std::complex<double> x = station.along_x.cast<std::complex<double>>().dot(shape);
    const std::complex<double> y = station.along_y.cast<std::complex<double>>().dot(shape);
    verdict.growth = std::max(verdict.growth, s.real());
    const bool forward = std::imag(std::conj(x) * y) < 0.0;  // x leads: it goes from x to y
    if (forward && s.real() > verdict.forward) {
      verdict.forward = s.real();
      verdict.decrement = -2.0 * M_PI * s.real() / s.imag();
    }
  }
  return verdict;
}

// Random machines of one disc in unlike bearings: it is as forward as the whole rotor.
TEST(CrossCouplingMargin, OfRandomRotorsInUnlikeBearingsIsThatOfAllTheirEigenvalues) {
  std::mt19937 random(40);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  for (int i = 0; i < 40; ++i) {
    // A flexible shaft between bearings with damping ratios up to far beyond 1: disc x, y,
    // journals.
    const double mass = uniform(5.0, 50.0), journal = uniform(0.5, 3.0);
    const double shaft = std::exp(uniform(std::log(1.0e6), std::log(1.0e8)));
    Eigen::Matrix4d m = Eigen::Vector4d(mass, mass, journal, journal).asDiagonal();
    Eigen::Matrix4d k = Eigen::Matrix4d::Zero(), c = Eigen::Matrix4d::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      const double bearing = shaft * std::exp(uniform(-2.0, 2.0));
      k(axis, axis) = shaft;
      k(axis, axis + 2) = k(axis + 2, axis) = -shaft;
      k(axis + 2, axis + 2) = shaft + bearing;
      c(axis + 2, axis + 2) = std::sqrt(bearing * mass) * std::exp(uniform(-3.0, 3.0));
    }
    RotorUnderTest r;
    r.rotor.matrices = [=](double) {
      return Linearization{m, c, Eigen::Matrix4d::Zero(), k, Eigen::Matrix4d::Zero()};
    };
    r.rotor.load = Eigen::VectorXd::Zero(4);
    r.stations = {{"disc", 0.0, Eigen::VectorXd::Unit(4, 0), Eigen::VectorXd::Unit(4, 1)}};
    const auto dense = [&](double q) {
      return denseVerdict(withCrossCoupling(r.rotor.matrices(0.0), r.stations[0], q),
                          r.stations[0]);
    };
    const std::optional<double> margin = crossCouplingMargin(r.rotor, r.stations, 0, 100.0);
    ASSERT_TRUE(margin) << i;
    EXPECT_LT(dense(0.999 * *margin).growth, 0.0) << i;
    EXPECT_GT(dense(1.001 * *margin).growth, 0.0) << i;
    for (double q = 1.0e-3 * *margin; q < *margin; q *= 1.2) {
      EXPECT_LT(dense(q).growth, 0.0) << "machine " << i << " grows before, at " << q;
    }
    for (const double part : {0.3, 0.6, 0.95, 1.3}) {
      const double q = part * *margin;
      const auto rows = slowestForwardMode(r.rotor, r.stations, 0, 100.0, {q});
      if (dense(q).forward > -1.0e300) {
        ASSERT_EQ(rows.size(), 1u) << i;
        EXPECT_NEAR(rows[0].mode.logDecrement(), dense(q).decrement,
                    1.0e-3 * std::fabs(dense(q).decrement) + 1.0e-9)
            << "machine " << i << " at " << part << " of Q_0";
      }
    }
  }
}

TEST(CrossCouplingMargin, OfAnUndampedRotorIsZero) {
  const RotorUnderTest r = chainRotor(3, 5.0e5, 1.0, 0.0, 5.0);
  EXPECT_EQ(crossCouplingMargin(r.rotor, r.stations, 0, 5000.0).value(), 0.0);
}

}  // namespace rotor_stability_test

}  // namespace whirl_twin
