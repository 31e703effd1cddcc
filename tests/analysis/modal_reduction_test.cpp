// Reduction of a flexible rotor to a few modes: exact with all of them, better than modal
// truncation alone, and with a valid error bound.
#include "analysis/modal_reduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "algebra/dense.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {
namespace modal_reduction_test {

using Complex = std::complex<double>;
constexpr double kHighest = 450.0;  // rad/s: above four critical speeds

/// The two-disc rotor of Friswell et al. (2010), 28 coordinates.
FlexibleShaft twoDiscs(double damping) {
  FlexibleShaft shaft;
  shaft.material = {211.0e9, 81.2e9, 7810.0, true};
  shaft.elements.assign(6, {0.25, 0.05, 0.0});
  shaft.discs = {{2, 32.59, 0.3296, 0.1781}, {4, 51.53, 0.8051, 0.4236}};
  for (const int node : {0, 6}) {
    shaft.bearings.push_back({node, {1.0e6, 0.0, 0.0, 0.8e6, damping, 0.0, 0.0, damping}});
  }
  shaft.unbalances = {{2, 0.001, 0.3}};
  return shaft;
}

/// Stations with that of node 2 first.
std::vector<Station> stationsOf(const RotorAssembly& rotor) {
  std::vector<Station> stations = rotor.stations();
  std::swap(stations[0], stations[2]);
  return stations;
}

Complex responseX(const LinearRotor& rotor, const Station& station, double w) {
  const Linearization l = rotor.matrices(w);
  const Eigen::MatrixXcd dynamic = (l.stiffness + l.circulatory - w * w * l.mass).cast<Complex>() +
                                   Complex(0.0, w) * (l.damping + l.gyroscopic);
  const Eigen::VectorXcd q = ComplexLu(dynamic).solve(rotor.synchronousForce(w));
  return station.along_x.cast<Complex>().cwiseProduct(q).sum();
}

std::vector<Complex> eigenvaluesOf(const Linearization& l) {
  const Eigen::Index n = l.mass.rows();
  constexpr double kScale = 1.0e3;
  const Cholesky mass(l.mass);
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).diagonal().setConstant(kScale);
  state.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory) / kScale;
  state.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  const Eigen::VectorXcd all = eigenvalues(state).values;
  return {all.begin(), all.end()};
}

TEST(ModalReduction, keepsTheResponseWithinTheToleranceAskedFor) {
  for (const double damping : {0.0, 100.0, 3000.0}) {
    const RotorAssembly full(twoDiscs(damping));
    const auto stations = stationsOf(full);
    const RotorReduction r = reduceRotorTo(full.linearRotor(), stations, kHighest, 1.0e-6);
    EXPECT_LE(r.error.response, 1.0e-6);
    EXPECT_LT(r.shapes.cols(), 24) << damping;
    EXPECT_EQ(r.shapes.cols() % 2, 0);
    // At speeds outside the search grid, at least 1e-2 away from undamped resonances.
    const RotorAssembly reduced = full.in(r.shapes);
    for (const double w : {31.4, 111.1, 222.2, 333.3, 444.4}) {
      const Complex exact = responseX(full.linearRotor(), stations[0], w);
      const Complex found = responseX(reduced.linearRotor(), reduced.station(2), w);
      EXPECT_LT(std::abs(found - exact), 1.0e-5 * std::abs(exact)) << damping << ", " << w;
    }
  }
}

TEST(ModalReduction, isBetterThanModesAlone) {
  const RotorAssembly full(twoDiscs(3000.0));
  const LinearRotor rotor = full.linearRotor();
  const Linearization l = rotor.matrices(0.0);
  const SymmetricModes<double> modes = generalizedModes(l.stiffness, l.mass);
  const RotorAssembly truncated = full.in(modes.vectors.leftCols(16));
  const RotorReduction r = reduceRotor(rotor, stationsOf(full), kHighest, 16);
  double worst = 0.0;
  for (double w = 10.0; w <= kHighest; w += 10.0) {
    const Complex exact = responseX(rotor, full.station(2), w);
    const Complex found = responseX(truncated.linearRotor(), truncated.station(2), w);
    worst = std::max(worst, std::abs(found - exact) / std::abs(exact));
  }
  EXPECT_LT(r.error.response, 0.02 * worst);
}

TEST(ModalReduction, reportsTheErrorOfTheEigenvalues) {
  const RotorAssembly full(twoDiscs(3000.0));
  const LinearRotor rotor = full.linearRotor();
  for (const int count : {6, 12, 18}) {
    const RotorReduction r = reduceRotor(rotor, stationsOf(full), kHighest, count);
    const auto exact = eigenvaluesOf(rotor.matrices(kHighest));
    double worst = 0.0;
    for (const Complex& s : eigenvaluesOf(full.in(r.shapes).matrices(kHighest))) {
      if (std::abs(s) < kHighest) {
        double nearest = 1e9;
        for (const Complex& e : exact) {
          nearest = std::min(nearest, std::abs(s - e) / std::abs(e));
        }
        worst = std::max(worst, nearest);
      }
    }
    // The eigenvalues of the full rotor are good to 1e-9 themselves.
    EXPECT_NEAR(r.error.eigenvalue, worst, 1e-3 * worst + 1e-8) << count;
  }
}

TEST(ModalReduction, isExactWithEveryCoordinate) {
  const RotorAssembly full(twoDiscs(100.0));
  const RotorReduction r = reduceRotor(full.linearRotor(), stationsOf(full), kHighest, 28);
  ASSERT_EQ(r.shapes.cols(), 28);
  // Stiffnesses over six decades: rounding of 1e-16 times 1e6.
  EXPECT_LT(r.error.response, 1e-8);
  EXPECT_LT(r.error.eigenvalue, 1e-8);
}

TEST(ModalReduction, sagsAsTheFullRotor) {
  FlexibleShaft shaft = twoDiscs(100.0);
  shaft.gravity = 9.80665;
  const RotorAssembly full(shaft);
  const LinearRotor rotor = full.linearRotor();
  const Eigen::VectorXd sag = Ldlt(rotor.matrices(0.0).stiffness).solve(rotor.load);
  const RotorAssembly reduced = full.in(reduceRotor(rotor, stationsOf(full), kHighest, 10).shapes);
  const LinearRotor r = reduced.linearRotor();
  const Eigen::VectorXd q = Ldlt(r.matrices(0.0).stiffness).solve(r.load);
  for (int node = 0; node < 7; ++node) {
    EXPECT_NEAR(reduced.station(node).along_y.dot(q), full.station(node).along_y.dot(sag), 1e-12);
  }
}

// Both planes of an isotropic rotor have the same frequencies: its coordinates must still alternate
// between the planes of x and y, with the same signs whatever the rounding.
TEST(ModalReduction, tellsThePlanesOfARoundRotorApart) {
  FlexibleShaft shaft = twoDiscs(0.0);
  for (auto& bearing : shaft.bearings) {
    bearing.coefficients.kyy = bearing.coefficients.kxx;
  }
  FlexibleShaft rounded = shaft;
  rounded.bearings[0].coefficients.kxx *= 1.0 + 3.0e-15;
  rounded.elements[2].outer_diameter *= 1.0 - 2.0e-15;
  const RotorAssembly rotor(shaft);
  const RotorAssembly other(rounded);
  const std::vector<Station> stations = stationsOf(rotor);
  const RotorReduction r = reduceRotor(rotor.linearRotor(), stations, kHighest, 8);
  const RotorReduction o = reduceRotor(other.linearRotor(), stationsOf(other), kHighest, 8);
  EXPECT_LT((r.shapes - o.shapes).norm(), 1e-6 * r.shapes.norm());
  for (Eigen::Index i = 0; i < 8; ++i) {
    double along = 0.0, across = 0.0, farthest = 0.0;
    for (const Station& station : stations) {
      const double x = station.along_x.dot(r.shapes.col(i));
      const double y = station.along_y.dot(r.shapes.col(i));
      along = std::max(along, std::fabs(i % 2 == 0 ? x : y));
      across = std::max(across, std::fabs(i % 2 == 0 ? y : x));
      farthest = std::max(farthest, i % 2 == 0 ? x : y);
    }
    EXPECT_DOUBLE_EQ(along, 1.0) << i;
    EXPECT_LT(across, 1e-6) << i;
    EXPECT_GT(farthest, 0.99) << i << ": the farthest goes forward";
  }
}

TEST(ModalReduction, saysWhatItKeptAndWhy) {
  const RotorAssembly full(twoDiscs(100.0));
  const RotorReduction r = reduceRotorTo(full.linearRotor(), stationsOf(full), kHighest, 1.0e-6);
  EXPECT_EQ(r.note.rfind(std::to_string(r.shapes.cols()) + " of 28 modes", 0), 0u) << r.note;
  EXPECT_NE(r.note.find("<= 1e-06 up to 450 rad/s"), std::string::npos) << r.note;
}

TEST(ModalReduction, reducesARotorThatFloats) {
  FlexibleShaft shaft = twoDiscs(0.0);
  shaft.bearings.clear();
  const RotorAssembly full(shaft);
  const LinearRotor rotor = full.linearRotor();
  const double highest = usualHighestSpeed(rotor);
  EXPECT_GT(highest, 100.0) << "rigid-body modes do not count";
  const RotorReduction r = reduceRotorTo(rotor, stationsOf(full), highest, 1.0e-6);
  EXPECT_TRUE(r.shapes.allFinite());
  EXPECT_LE(r.error.response, 1.0e-6);
}

}  // namespace modal_reduction_test
}  // namespace whirl_twin
