// Rotors whose matrices hold entries of very different sizes, on supports of 1e3 to 1e20 N/m, of
// shafts of 7800 down to 1e-6 kg/m^3: their critical speeds and whirls against dense solutions in
// extended precision.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "analysis/campbell.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {
namespace stiff_rotors_test {

constexpr double kHighest = 3000.0;  // rad/s

/// Two or three supports, one to three discs; `damped`: by ratios of 0 to 5 in the supports.
FlexibleShaft stiffRotor(unsigned seed, bool damped) {
  std::mt19937 draws(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  const auto decades = [&](double low, double high) { return std::pow(10.0, between(low, high)); };
  FlexibleShaft shaft;
  shaft.material = {2.1e11, 8.1e10, decades(-6.0, 3.9)};
  const int elements = static_cast<int>(between(2.0, 14.99));
  const double length = between(0.4, 1.2) / elements;
  shaft.elements.assign(static_cast<std::size_t>(elements), {length, between(0.02, 0.06), 0.0});
  for (int i = static_cast<int>(between(1.0, 3.99)); i > 0; --i) {
    const double mass = decades(0.0, 1.5);
    const double across = mass * decades(-4.0, -2.0);
    shaft.discs.push_back({static_cast<int>(between(0.0, elements + 0.99)), mass,
                           across * between(0.0, 1.9), across});
  }
  for (const int node : {0, elements}) {
    BearingCoefficients b;
    b.kxx = decades(3.0, 20.0);
    b.kyy = between(0.0, 1.0) < 0.5 ? b.kxx : b.kxx * between(0.5, 2.0);
    if (damped) {
      b.cxx = b.cyy = 2.0 * between(0.0, 5.0) * std::sqrt(b.kxx * 5.0);
    }
    shaft.bearings.push_back({node, b});
  }
  return shaft;
}

/// [rad/s], ascending, up to the highest: K phi = w^2 (M - i G / w) phi.
std::vector<double> synchronousSpeeds(const LinearRotor& rotor) {
  using Long = std::complex<long double>;
  using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
  const Linearization l = rotor.matrices(1.0);
  const LongMatrix inertia = l.mass.cast<Long>() - Long(0.0L, 1.0L) * l.gyroscopic.cast<Long>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<LongMatrix> solver(
      inertia, l.stiffness.cast<Long>(), Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  EXPECT_EQ(solver.info(), Eigen::Success);
  std::vector<double> speeds;
  for (const long double mu : solver.eigenvalues()) {
    if (mu > 0.0L && std::sqrt(mu) * kHighest >= 1.0L) {
      speeds.push_back(static_cast<double>(1.0L / std::sqrt(mu)));
    }
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

TEST(StiffRotors, HaveAllTheirCriticalSpeedsOnEveryGrid) {
  std::size_t all = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const RotorAssembly assembly(stiffRotor(seed, false));
    const LinearRotor rotor = assembly.linearRotor();
    const std::vector<double> expected = synchronousSpeeds(rotor);
    all += expected.size();
    for (const std::size_t points : {3U, 17U}) {
      std::vector<double> speeds;
      for (std::size_t k = 0; k < points; ++k) {
        speeds.push_back(kHighest * static_cast<double>(k) / static_cast<double>(points - 1));
      }
      const CampbellDiagram diagram = campbell(rotor, assembly.stations(), {speeds});
      ASSERT_EQ(diagram.crossings.size(), expected.size()) << seed << ' ' << points;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(diagram.crossings[i].speed, expected[i], 1.0e-7 * expected[i]) << seed;
      }
    }
  }
  EXPECT_GT(all, 20U);
}

/// [1/s], with the lowest to all digits: the reciprocals of the eigenvalues of the inverse problem
/// [-(K + N)^-1 (C + G), -(K + N)^-1 M; 1, 0] of (phi, s phi).
std::vector<std::complex<double>> lowestOfAll(const Linearization& l) {
  using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index n = l.mass.rows();
  const Eigen::PartialPivLU<LongMatrix> place((l.stiffness + l.circulatory).cast<long double>());
  LongMatrix a = LongMatrix::Zero(2 * n, 2 * n);
  a.topLeftCorner(n, n) = -place.solve((l.damping + l.gyroscopic).cast<long double>());
  a.topRightCorner(n, n) = -kHighest * place.solve(l.mass.cast<long double>());
  a.bottomLeftCorner(n, n).diagonal().setConstant(1.0L / kHighest);
  Eigen::EigenSolver<LongMatrix> solver;
  solver.setMaxIterations(800 * n).compute(a, false);
  EXPECT_EQ(solver.info(), Eigen::Success);
  std::vector<std::complex<double>> all;
  for (const std::complex<long double>& inverse : solver.eigenvalues()) {
    if (std::abs(inverse) * 1.0e9L > 1.0L) {
      const std::complex<long double> s = 1.0L / inverse;
      all.emplace_back(static_cast<double>(s.real()), static_cast<double>(s.imag()));
    }
  }
  return all;
}

// As many whirls are slower than the shaft at its highest speed as have met it.
TEST(StiffRotors, MeetTheSpeedAsOftenAsTheirDampedWhirlsAreOvertaken) {
  int all = 0;
  for (unsigned seed = 101; seed <= 110; ++seed) {
    const RotorAssembly assembly(stiffRotor(seed, true));
    const LinearRotor rotor = assembly.linearRotor();
    const CampbellDiagram diagram =
        campbell(rotor, assembly.stations(), {{0.0, 400.0, 1700.0, kHighest}});
    const auto slower = [&](double speed) {
      int count = 0;  // the overdamped in pairs
      for (const std::complex<double>& s : lowestOfAll(rotor.matrices(speed))) {
        const double vibrates = std::fabs(s.imag()) > 1.0e-9 * std::abs(s) ? s.imag() : 0.0;
        count += std::fabs(vibrates) < speed ? 1 : 0;
      }
      return count / 2;
    };
    int net = 0;
    for (const CampbellCrossing& one : diagram.crossings) {
      net += one.slows ? 1 : -1;
      double nearest = kHighest;
      for (const std::complex<double>& s : lowestOfAll(rotor.matrices(one.speed))) {
        nearest = std::min(nearest, std::fabs(s.imag() - one.speed));
      }
      EXPECT_LE(nearest, 1.0e-6 * one.speed) << seed;
    }
    EXPECT_EQ(net, slower(kHighest) - slower(0.01)) << seed;
    all += net;
  }
  EXPECT_GT(all, 10);
}

}  // namespace stiff_rotors_test
}  // namespace whirl_twin
