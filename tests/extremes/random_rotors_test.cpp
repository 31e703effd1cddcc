// Three hundred random rotors in full length, twenty otherwise, against dense generalized
// eigenproblems in extended precision: of supports from 1e3 to 1e20 N/m, undamped and with damping
// ratios of 0 to 5, and of plain films at eccentricities of 0.05 to 0.95; shafts of any density
// down to 1e-6 kg/m^3 and without mass, 2 to 60 elements. None of their critical speeds is missed,
// none invented, no verdict on stability is wrong.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <random>
#include <vector>

#include "analysis/campbell.h"
#include "analysis/stability.h"
#include "measured.h"
#include "mechanics/rotors/bearing_laws.h"

namespace whirl_twin {
namespace random_rotors_test {

using Eigen::Index;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongComplex = std::complex<long double>;
using LongComplexMatrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double kHighest = 2500.0;  // rad/s

enum class Supports { kUndamped, kDamped, kFilms };

struct DrawnRotor {
  FlexibleShaft shaft;
  Supports supports = Supports::kUndamped;
  double speed = 0.0;  ///< [rad/s], that its stability is judged at
};

DrawnRotor drawnRotor(unsigned seed) {
  std::mt19937 draws(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  const auto decades = [&](double low, double high) { return std::pow(10.0, between(low, high)); };
  DrawnRotor r;
  r.supports = static_cast<Supports>(seed % 3);
  r.speed = between(50.0, kHighest);
  FlexibleShaft& shaft = r.shaft;
  shaft.material = {2.1e11, 8.1e10, seed % 5 == 0 ? 0.0 : decades(-6.0, 3.9)};
  const double most = std::log10(fullLength() ? 60.99 : 10.99);
  const int elements = static_cast<int>(decades(std::log10(2.0), most));
  const double length = between(0.4, 1.2) / elements;
  shaft.elements.assign(static_cast<std::size_t>(elements), {length, between(0.02, 0.06), 0.0});
  double mass = 0.0;
  for (int i = static_cast<int>(between(1.0, 3.99)); i > 0; --i) {
    const double own = decades(0.0, 1.5);
    const double across = own * decades(-4.0, -2.0);
    shaft.discs.push_back(
        {static_cast<int>(between(0.0, elements + 0.99)), own, across * between(0.0, 1.9), across});
    mass += own;
  }
  for (const int node : {0, elements}) {
    if (r.supports == Supports::kFilms) {
      ShortJournalBearing film{between(0.01, 0.04), 0.05, 5.0e-5, 0.02};
      const double load = 0.5 * 9.81 * mass;
      // The load of a film is proportional to its oil.
      film.viscosity *= film.speedAt(load, between(0.05, 0.95)) / std::max(r.speed, 1.0);
      shaft.speed_bearings.push_back(journalBearing(node, film, load));
      continue;
    }
    if (r.supports == Supports::kUndamped && seed % 4 == 0) {
      shaft.rigid_supports.push_back({node, node == 0 && seed % 8 == 0});
      continue;
    }
    BearingCoefficients b;
    b.kxx = decades(3.0, 20.0);
    b.kyy = between(0.0, 1.0) < 0.5 ? b.kxx : b.kxx * between(0.5, 2.0);
    if (r.supports == Supports::kDamped) {
      b.cxx = b.cyy = 2.0 * between(0.0, 5.0) * std::sqrt(b.kxx * 5.0);
    }
    shaft.bearings.push_back({node, b});
  }
  return r;
}

/// [rad/s], ascending: K phi = w^2 (M - i G / w) phi.
std::vector<double> synchronousSpeeds(const LinearRotor& rotor) {
  const Linearization l = rotor.matrices(1.0);
  const LongComplexMatrix inertia =
      l.mass.cast<LongComplex>() - LongComplex(0.0L, 1.0L) * l.gyroscopic.cast<LongComplex>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<LongComplexMatrix> solver(
      inertia, l.stiffness.cast<LongComplex>(), Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
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

/// [1/s], below 1e9: the reciprocals of the eigenvalues of the inverse problem
/// [-(K + N)^-1 (C + G), -(K + N)^-1 M; 1, 0] of (phi, s phi).
std::vector<std::complex<double>> denseRoots(const Linearization& l) {
  const Index n = l.mass.rows();
  const Eigen::PartialPivLU<LongMatrix> place((l.stiffness + l.circulatory).cast<long double>());
  LongMatrix a = LongMatrix::Zero(2 * n, 2 * n);
  a.topLeftCorner(n, n) = -place.solve((l.damping + l.gyroscopic).cast<long double>());
  a.topRightCorner(n, n) = -kHighest * place.solve(l.mass.cast<long double>());
  a.bottomLeftCorner(n, n).diagonal().setConstant(1.0L / kHighest);
  Eigen::EigenSolver<LongMatrix> solver;
  solver.setMaxIterations(800 * n).compute(a, false);
  EXPECT_EQ(solver.info(), Eigen::Success);
  std::vector<std::complex<double>> all;
  for (const LongComplex& inverse : solver.eigenvalues()) {
    if (std::abs(inverse) * 1.0e9L > 1.0L) {
      const LongComplex s = 1.0L / inverse;
      all.emplace_back(static_cast<double>(s.real()), static_cast<double>(s.imag()));
    }
  }
  return all;
}

/// [rad/s], of what vibrates, ascending.
std::vector<double> frequencies(const std::vector<std::complex<double>>& roots) {
  std::vector<double> all;
  for (const std::complex<double>& s : roots) {
    if (s.imag() > 1.0e-9 * std::abs(s)) {
      all.push_back(s.imag());
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// How many modes are faster than the speed at `low` and slower than it at `high`, less those the
/// other way. Overdamped ones are slower at any speed. Counted up to the widest gap in the
/// frequencies: beyond it no mode meets the speed, and those of light shafts are too fast to count.
int overtaken(const LinearRotor& rotor, double low, double high) {
  const std::vector<double> before = frequencies(denseRoots(rotor.matrices(low)));
  const std::vector<double> after = frequencies(denseRoots(rotor.matrices(high)));
  std::vector<double> fast{10.0 * high, 1.0e8};
  for (const std::vector<double>* all : {&before, &after}) {
    std::copy_if(all->begin(), all->end(), std::back_inserter(fast),
                 [&](double w) { return w > fast[0] && w < fast[1]; });
  }
  std::sort(fast.begin(), fast.end());
  double top = fast.front(), widest = 1.0;
  for (std::size_t i = 1; i < fast.size(); ++i) {
    if (fast[i] > widest * fast[i - 1]) {
      widest = fast[i] / fast[i - 1];
      top = std::sqrt(fast[i] * fast[i - 1]);
    }
  }
  const auto faster = [&](const std::vector<double>& all, double speed) {
    return static_cast<int>(std::lower_bound(all.begin(), all.end(), top) -
                            std::lower_bound(all.begin(), all.end(), speed));
  };
  return faster(before, low) - faster(after, high);
}

/// By how much of s the equations are off from having the root s: a step of Newton's method on the
/// determinant, 1 / tr(D^-1 dD/ds).
double offRoot(const Linearization& l, std::complex<double> s) {
  const LongComplex root(s.real(), s.imag());
  const auto in = [](const Eigen::MatrixXd& m) { return LongComplexMatrix(m.cast<LongComplex>()); };
  const LongComplexMatrix rates = in(l.damping + l.gyroscopic);
  const LongComplexMatrix d =
      root * root * in(l.mass) + root * rates + in(l.stiffness + l.circulatory);
  const LongComplex trace =
      Eigen::PartialPivLU<LongComplexMatrix>(d).solve(2.0L * root * in(l.mass) + rates).trace();
  return static_cast<double>(1.0L / std::abs(trace) / std::abs(root));
}

struct Tally {
  int crossings = 0, uncertain = 0, judged = 0;
  double worst = 0.0;  ///< of a critical speed
};

void compareUndamped(const LinearRotor& rotor, const CampbellDiagram& diagram, unsigned seed,
                     Tally& tally) {
  const std::vector<double> expected = synchronousSpeeds(rotor);
  std::vector<double> found;
  for (const CampbellCrossing& one : diagram.crossings) {
    found.push_back(one.speed);
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), expected.size()) << "rotor " << seed;
  for (std::size_t i = 0; i < found.size(); ++i) {
    tally.worst = std::max(tally.worst, std::fabs(found[i] / expected[i] - 1.0));
  }
  tally.crossings += static_cast<int>(found.size());
}

void compareDamped(const LinearRotor& rotor, const CampbellDiagram& diagram, unsigned seed,
                   Tally& tally) {
  int net = 0;
  for (const CampbellCrossing& one : diagram.crossings) {
    net += one.slows ? 1 : -1;
    const std::complex<double> s(-one.mode.decay_rate, one.mode.frequency);
    EXPECT_NEAR(one.mode.frequency, one.speed, 1.0e-6 * one.speed) << "rotor " << seed;
    tally.worst = std::max(tally.worst, offRoot(rotor.matrices(one.speed), s));
  }
  // At standstill itself what is overdamped has the speed of the shaft, none.
  const double lowest = std::max(diagram.speeds.front(), 1.0e-3);
  EXPECT_EQ(net, overtaken(rotor, lowest, kHighest)) << "rotor " << seed;
  tally.crossings += static_cast<int>(diagram.crossings.size());
}

void compareVerdict(const LinearRotor& rotor, const DrawnRotor& drawn, unsigned seed,
                    Tally& tally) {
  const Linearization l = rotor.matrices(drawn.speed);
  const Verdict verdict = stability(l, 0).routh.verdict;
  ++tally.judged;
  if (verdict == Verdict::kUncertain) {
    ++tally.uncertain;
    return;
  }
  double growth = -1.0e300, size = 0.0;
  for (const std::complex<double>& s : denseRoots(l)) {
    growth = std::max(growth, s.real());
    size = std::max(size, std::abs(s));
  }
  // Within the rounding of the long doubles themselves nothing is known.
  if (std::fabs(growth) > 1.0e-7) {
    EXPECT_EQ(verdict == Verdict::kUnstable, growth > 0.0)
        << "rotor " << seed << ", growth rate " << growth;
  }
}

TEST(RandomRotors, HaveTheCriticalSpeedsAndVerdictsOfDenseSolutions) {
  Tally tally;
  const unsigned rotors = fullLength() ? 300 : 20;
  for (unsigned seed = 1; seed <= rotors; ++seed) {
    const DrawnRotor drawn = drawnRotor(seed);
    const RotorAssembly assembly(drawn.shaft);
    const LinearRotor rotor = assembly.linearRotor();
    std::vector<double> speeds;
    const double first = drawn.supports == Supports::kFilms ? 5.0 : 0.0;
    const int points = 3 + static_cast<int>(seed % 40);
    for (int k = 0; k < points; ++k) {
      speeds.push_back(first + (kHighest - first) * k / (points - 1));
    }
    const CampbellDiagram diagram = campbell(rotor, assembly.stations(), {speeds});
    if (drawn.supports == Supports::kUndamped) {
      compareUndamped(rotor, diagram, seed, tally);
    } else {
      compareDamped(rotor, diagram, seed, tally);
      compareVerdict(rotor, drawn, seed, tally);
    }
    if (HasFatalFailure()) {
      return;
    }
  }
  EXPECT_GT(tally.crossings, static_cast<int>(rotors));
  expectWithin(1.0e-6, tally.worst, "critical speeds of random rotors, of themselves");
  // Stiff supports let next to no damping act: what decays by 1e-9 1/s cannot be distinguished from
  // no decay.
  expectWithin(0.6, static_cast<double>(tally.uncertain) / tally.judged,
               "random rotors with an uncertain verdict, of all");
}

}  // namespace random_rotors_test
}  // namespace whirl_twin
