// Three hundred random rotors in full length, twenty otherwise, against dense generalized
// eigenproblems in extended precision: with supports from 1e3 to 1e20 N/m, undamped and with
// damping ratios of 0 to 5, and with plain bearings at eccentricities of 0.05 to 0.95; shafts of
// any density down to 1e-6 kg/m^3 and without mass, 2 to 60 elements. No critical speed is missed,
// none is spurious, no stability verdict is wrong.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
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
const long double kTurn = 2.0L * std::acos(-1.0L);

enum class Supports { kUndamped, kDamped, kFilms };

struct DrawnRotor {
  FlexibleShaft shaft;
  Supports supports = Supports::kUndamped;
  double speed = 0.0;  ///< [rad/s], of the stability evaluation
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

/// det(s^2 M + s (C + G) + K + N) by elimination with partial pivoting.
class Determinant {
 public:
  explicit Determinant(const Linearization& l)
      : mass_(l.mass.cast<long double>()),
        rates_((l.damping + l.gyroscopic).cast<long double>()),
        places_((l.stiffness + l.circulatory).cast<long double>()) {
    for (Index j = 0; j < mass_.cols(); ++j) {
      for (Index i = 0; i < mass_.rows(); ++i) {
        if (mass_(i, j) != 0.0L || rates_(i, j) != 0.0L || places_(i, j) != 0.0L) {
          width_ = std::max(width_, std::abs(i - j));
        }
      }
    }
  }

  LongComplex phase(const LongComplex& s) const {
    const Index n = mass_.rows();
    LongComplexMatrix a = LongComplexMatrix::Zero(n, n);
    for (Index j = 0; j < n; ++j) {
      for (Index i = std::max(Index{0}, j - width_); i <= std::min(n - 1, j + width_); ++i) {
        a(i, j) = places_(i, j) + s * (rates_(i, j) + s * mass_(i, j));
      }
    }
    LongComplex phase = 1.0L;
    for (Index k = 0; k < n; ++k) {
      const Index below = std::min(n - k, width_ + 1), wide = std::min(n - k, 2 * width_ + 1);
      Index pivot = 0;
      a.col(k).segment(k, below).cwiseAbs2().maxCoeff(&pivot);
      if (pivot != 0) {
        a.row(k).segment(k, wide).swap(a.row(k + pivot).segment(k, wide));
        phase = -phase;
      }
      phase *= a(k, k) / std::abs(a(k, k));
      for (Index i = k + 1; i < k + below; ++i) {
        const LongComplex factor = a(i, k) / a(k, k);
        a.row(i).segment(k, wide) -= factor * a.row(k).segment(k, wide);
      }
    }
    return phase;
  }

 private:
  LongMatrix mass_, rates_, places_;
  Index width_ = 0;
};

/// [rad], by how much the phase of a determinant turns while its s runs from u = 0 to 1: in steps
/// well below Im s, the distance to real roots, whose turns are those that its slopes at their ends
/// make.
template <class Phase, class Root>
long double turnOf(const Phase& phase, const Root& root) {
  const auto slope = [&](long double u, const LongComplex& there) {
    const long double d = u > 0.5L ? -1.0e-7L : 1.0e-7L;
    return std::arg(phase(u + d) * std::conj(there)) / d;
  };
  long double u = 0.0L, sum = 0.0L, step = 0.02L;
  LongComplex before = phase(u);
  long double rate = slope(u, before);
  while (u < 1.0L) {
    const LongComplex s = root(u);
    const long double rush = std::abs(root(u + 1.0e-7L) - s) * 1.0e7L;
    step =
        std::min({2.0L * step, 0.05L, 0.4L * s.imag() / rush, 0.7L / (std::fabs(rate) + 1.0e-9L)});
    for (;; step *= 0.5L) {
      const long double next = std::min(1.0L, u + step);
      const LongComplex after = phase(next);
      const long double next_rate = slope(next, after);
      const long double expected = 0.5L * (next - u) * (rate + next_rate);
      const long double off = std::remainder(std::arg(after * std::conj(before)) - expected, kTurn);
      if ((std::fabs(off) < 0.03L && std::fabs(expected) < 1.2L) || step < 1.0e-12L) {
        EXPECT_GE(step, 1.0e-12L) << "a root is on the path";
        sum += expected + off;
        u = next;
        before = after;
        rate = next_rate;
        break;
      }
    }
  }
  return sum;
}

/// Of speeds, and of decay rates over the speed, up to a damping ratio of 0.7: a mode with more
/// damping hardly completes a revolution, and is no whirl.
struct Cells {
  std::vector<double> speeds;                                            ///< [rad/s]
  std::vector<double> decays{-25.0, -0.5, 0.25, 0.7 / std::sqrt(0.51)};  ///< [-]
};

/// For each cell of speeds, then of decays, the number of modes whose frequency falls below the
/// speed minus those that rise above it: the winding number of det D(i w - d; w) along the cell's
/// border, since that is zero where an eigenvalue i w - d meets the speed.
std::vector<int> slowedIn(const LinearRotor& rotor, const Cells& cells) {
  const auto root = [](long double speed, long double x) -> LongComplex {
    return speed * LongComplex(-std::sinh(x), 1.0L);
  };
  const auto across = [&](double speed, double from, double to) {
    const Determinant d(rotor.matrices(speed));
    const long double first = std::asinh(from), last = std::asinh(to);
    const auto way = [&](long double u) { return root(speed, first + u * (last - first)); };
    return turnOf([&](long double u) { return d.phase(way(u)); }, way);
  };
  const auto along = [&](double decay, double low, double high) {
    const auto speed = [&](long double u) { return low + u * (high - low); };
    const auto way = [&](long double u) { return root(speed(u), std::asinh(decay)); };
    return turnOf(
        [&](long double u) {
          return Determinant(rotor.matrices(static_cast<double>(speed(u)))).phase(way(u));
        },
        way);
  };
  std::vector<long double> turns((cells.speeds.size() - 1) * (cells.decays.size() - 1), 0.0L);
  const auto of = [&](std::size_t k, std::size_t i) -> long double& {
    return turns[k * (cells.decays.size() - 1) + i];
  };
  for (std::size_t k = 0; k < cells.speeds.size(); ++k) {
    for (std::size_t i = 0; i < cells.decays.size(); ++i) {
      if (i + 1 < cells.decays.size()) {
        const long double turn = across(cells.speeds[k], cells.decays[i], cells.decays[i + 1]);
        k + 1 < cells.speeds.size() ? void(of(k, i) -= turn) : void();
        k > 0 ? void(of(k - 1, i) += turn) : void();
      }
      if (k + 1 < cells.speeds.size()) {
        const long double turn = along(cells.decays[i], cells.speeds[k], cells.speeds[k + 1]);
        i > 0 ? void(of(k, i - 1) -= turn) : void();
        i + 1 < cells.decays.size() ? void(of(k, i) += turn) : void();
      }
    }
  }
  std::vector<int> slowed;
  for (const long double turn : turns) {
    slowed.push_back(static_cast<int>(std::lround(turn / kTurn)));
  }
  return slowed;
}

/// [1/s], of Newton's method on the determinant: 1 / tr(D^-1 dD/ds).
std::complex<double> newtonStep(const Linearization& l, std::complex<double> s) {
  const LongComplex root(s.real(), s.imag());
  const auto in = [](const Eigen::MatrixXd& m) { return LongComplexMatrix(m.cast<LongComplex>()); };
  const LongComplexMatrix rates = in(l.damping + l.gyroscopic);
  const LongComplexMatrix d =
      root * root * in(l.mass) + root * rates + in(l.stiffness + l.circulatory);
  const LongComplex step =
      1.0L /
      Eigen::PartialPivLU<LongComplexMatrix>(d).solve(2.0L * root * in(l.mass) + rates).trace();
  return {static_cast<double>(step.real()), static_cast<double>(step.imag())};
}

/// Residual of the equations for a root s, relative to s.
double offRoot(const Linearization& l, std::complex<double> s) {
  return std::abs(newtonStep(l, s)) / std::abs(s);
}

/// The root of the dense solution that grows fastest, after steps of Newton's method: roots of
/// light nodes have errors of their size.
std::complex<double> fastestGrowing(const Linearization& l) {
  std::vector<std::complex<double>> roots = denseRoots(l);
  const auto slower = [](const auto& a, const auto& b) { return a.real() < b.real(); };
  for (std::size_t tries = 0; tries < 4 * roots.size(); ++tries) {
    auto& fastest = *std::max_element(roots.begin(), roots.end(), slower);
    const std::complex<double> better = fastest - newtonStep(l, fastest);
    const bool settled = std::abs(better - fastest) <= 1.0e-12 * std::abs(fastest);
    fastest = better;
    if (settled || fastest.real() < -1.0e-3 * std::abs(fastest)) {
      break;
    }
  }
  return *std::max_element(roots.begin(), roots.end(), slower);
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
  Cells cells;
  // At standstill every overdamped mode has the speed of the shaft, zero: start at a thousandth of
  // the first step.
  const double lowest = std::max(diagram.speeds.front(), 1.0e-3 * diagram.speeds[1]);
  const int count = fullLength() ? 8 : 4;
  for (int k = 0; k <= count; ++k) {
    cells.speeds.push_back(lowest + (kHighest - lowest) * std::pow(k / (1.0 * count), 1.6));
  }
  const auto cellOf = [](const std::vector<double>& borders, double value) {
    return std::upper_bound(borders.begin(), borders.end(), value) - borders.begin() - 1;
  };
  const auto bands = static_cast<std::ptrdiff_t>(cells.decays.size()) - 1;
  std::vector<int> found(static_cast<std::size_t>(count * bands), 0);
  for (const CampbellCrossing& one : diagram.crossings) {
    const std::complex<double> s(-one.mode.decay_rate, one.mode.frequency);
    EXPECT_NEAR(one.mode.frequency, one.speed, 1.0e-6 * one.speed) << "rotor " << seed;
    tally.worst = std::max(tally.worst, offRoot(rotor.matrices(one.speed), s));
    const auto band = cellOf(cells.decays, one.mode.decay_rate / one.speed);
    if (band >= 0 && band < bands) {
      const auto cell = std::min<std::ptrdiff_t>(cellOf(cells.speeds, one.speed), count - 1);
      found[static_cast<std::size_t>(cell * bands + band)] += one.slows ? 1 : -1;
    }
  }
  EXPECT_EQ(found, slowedIn(rotor, cells)) << "rotor " << seed;
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
  const std::complex<double> root = fastestGrowing(l);
  // Within the rounding of the long doubles themselves nothing is known: elimination takes five of
  // their digits.
  if (std::fabs(root.real()) > std::max(1.0e-7, 1.0e-14 * std::abs(root))) {
    EXPECT_EQ(verdict == Verdict::kUnstable, root.real() > 0.0)
        << "rotor " << seed << ", root " << root;
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
