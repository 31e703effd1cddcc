#include "analysis/synchronous_poles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algebra/dense.h"
#include "analysis/banded_rotor.h"
#include "analysis/lowest_roots.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double kPolynomial = 1.0e-9;  // third difference of a polynomial of degree two: rounding
constexpr double kPiece = 3.0;          // ratio of the ends of a piece
constexpr double kMinSpeedWidth = 1.0e-5;  // of a speed: nearer to a pole the response is rounding
constexpr double kWidest = 0.9;            // of a speed: no resonance
constexpr double kRoundPiece = 0.6;        // of a piece: radius of the circle about it

/// Do the matrices follow polynomials of degree two from `speed` to four times it?
bool polynomial(const BandedRotor& rotor, double speed) {
  const std::array<BandedLinearization, 4> l{rotor.matrices(speed), rotor.matrices(2.0 * speed),
                                             rotor.matrices(3.0 * speed),
                                             rotor.matrices(4.0 * speed)};
  const auto straight = [&](BandedMatrix<double> BandedLinearization::*m) {
    BandedMatrix<double> difference = l[3].*m;
    difference.add(-3.0, l[2].*m);
    difference.add(3.0, l[1].*m);
    difference.add(-1.0, l[0].*m);
    const double size = std::max((l[0].*m).largest(), (l[3].*m).largest());
    return difference.largest() <= kPolynomial * size;
  };
  return straight(&BandedLinearization::damping) && straight(&BandedLinearization::gyroscopic) &&
         straight(&BandedLinearization::stiffness) && straight(&BandedLinearization::circulatory);
}

/// K + N - w^2 M + i w (C + G) in w - middle, its matrices polynomials through the speeds from,
/// middle and to.
BandedPencil<Complex> pencilOfPiece(const BandedRotor& rotor, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  const BandedLinearization below = rotor.matrices(from);
  const BandedLinearization there = rotor.matrices(middle);
  const BandedLinearization above = rotor.matrices(to);
  BandedPencil<Complex> p{BandedMatrix<Complex>(there.size(), 0),
                          BandedMatrix<Complex>(there.size(), 0),
                          BandedMatrix<Complex>(there.size(), 0)};
  const auto add = [&](BandedMatrix<double> (BandedLinearization::*of)() const,
                       const Complex& constant, const Complex& linear) {
    const BandedMatrix<double> value = (there.*of)();
    BandedMatrix<double> slope = (above.*of)();
    slope.add(-1.0, (below.*of)());
    BandedMatrix<double> curvature = (above.*of)();
    curvature.add(-2.0, value);
    curvature.add(1.0, (below.*of)());
    // (constant + linear x) (value + slope x / 2 h + curvature x^2 / 2 h^2)
    p.a0.add(constant, value);
    p.a1.add(linear, value);
    p.a1.add(constant / (2.0 * half), slope);
    p.a2.add(linear / (2.0 * half), slope);
    p.a2.add(constant / (2.0 * half * half), curvature);
  };
  add(&BandedLinearization::byPlace, 1.0, 0.0);
  add(&BandedLinearization::byRate, Complex(0.0, middle), Complex(0.0, 1.0));
  p.a0.add(-middle * middle, there.mass);
  p.a1.add(-2.0 * middle, there.mass);
  p.a2.add(-1.0, there.mass);
  return p;
}

/// Poles of a piece for a rotor with many coordinates: those of resonances (kWidest) and some
/// others. Nothing where rootsWithin() has no result.
std::optional<std::vector<Complex>> lowestPolesOfPiece(const BandedRotor& rotor, double from,
                                                       double to) {
  const auto found = rootsWithin(pencilOfPiece(rotor, from, to), kRoundPiece * (to - from));
  if (!found) {
    return std::nullopt;
  }
  std::vector<Complex> poles;
  for (const RefinedEigenpair& root : found->roots) {
    poles.push_back(0.5 * (from + to) + root.value);
  }
  return poles;
}

/// Poles of the polynomial through the speeds from, to/2 + from/2 and to: with w = from + scale /
/// u, (D2 + u D1 + u^2 D0) X = 0.
std::vector<Complex> polesOfPiece(const LinearRotor& rotor, double from, double to, double scale) {
  const auto at = [&](double speed) { return synchronousStiffness(rotor.matrices(speed), speed); };
  const double h = to - from;
  const MatrixXcd low = at(from);
  const MatrixXcd middle = at(from + 0.5 * h);
  const MatrixXcd high = at(to);
  const MatrixXcd first = (scale / h) * (4.0 * middle - 3.0 * low - high);
  const MatrixXcd second = (2.0 * scale * scale / (h * h)) * (high - 2.0 * middle + low);
  const Index n = low.rows();
  const ComplexLu lu(low);
  MatrixXcd companion = MatrixXcd::Zero(2 * n, 2 * n);
  companion.topLeftCorner(n, n) = -lu.solve(first);
  companion.topRightCorner(n, n) = -lu.solve(second);
  companion.bottomLeftCorner(n, n).setIdentity();
  std::vector<Complex> poles;
  if (!companion.allFinite()) {
    return poles;
  }
  const EigenPairs solver = eigenvalues(companion);
  for (const Complex& u : solver.values) {
    if (std::abs(u) > 0.0) {
      poles.push_back(from + scale / u);
    }
  }
  return poles;
}

}  // namespace

MatrixXcd synchronousStiffness(const Linearization& l, double speed) {
  MatrixXcd d(l.mass.rows(), l.mass.cols());
  d.real() = l.stiffness + l.circulatory - speed * speed * l.mass;
  d.imag() = speed * (l.damping + l.gyroscopic);
  return d;
}

std::vector<Complex> synchronousPoles(const LinearRotor& rotor, double low, double high) {
  const BandedRotor chain(rotor);
  bool simple = rotor.knots.empty();
  for (double speed = low; simple && speed < high; speed *= 10.0) {
    simple = polynomial(chain, speed);
  }
  std::vector<double> ends{low};
  if (!simple) {
    while (ends.back() * kPiece < high) {
      ends.push_back(ends.back() * kPiece);
    }
    std::copy_if(rotor.knots.begin(), rotor.knots.end(), std::back_inserter(ends),
                 [&](double knot) { return knot > low && knot < high; });
    std::sort(ends.begin(), ends.end());
  }
  ends.push_back(high);
  std::vector<Complex> found;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    // Over the whole range every piece has the same polynomial: a short piece is the most accurate.
    const double to = simple ? std::min(high, 100.0 * low) : ends[i + 1];
    std::optional<std::vector<Complex>> poles;
    if (rotor.dof() > kMaxCompleteCoordinates) {
      poles = lowestPolesOfPiece(chain, ends[i], ends[i + 1]);
    }
    for (const Complex& pole : poles ? *poles : polesOfPiece(rotor, ends[i], to, to)) {
      if (pole.real() >= 0.98 * ends[i] && pole.real() <= 1.02 * ends[i + 1]) {
        found.push_back(pole);
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const Complex& a, const Complex& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  return found;
}

std::vector<double> speedsToLookAt(const std::vector<Complex>& poles, double low, double high,
                                   int coarse) {
  std::vector<double> speeds;
  for (int i = 0; i <= coarse; ++i) {
    speeds.push_back(low * std::pow(high / low, static_cast<double>(i) / coarse));
  }
  for (const Complex& pole : poles) {
    const double width = std::max(std::fabs(pole.imag()), kMinSpeedWidth * pole.real());
    if (width > kWidest * pole.real()) {
      continue;
    }
    for (const double t : {0.02, 0.1, 0.3, 0.6, 1.0, 1.7, 3.0, 6.0, 15.0, 40.0}) {
      if (t * width < 0.5 * pole.real()) {
        speeds.push_back(pole.real() - t * width);
        speeds.push_back(pole.real() + t * width);
      }
    }
  }
  speeds.erase(
      std::remove_if(speeds.begin(), speeds.end(), [&](double w) { return w < low || w > high; }),
      speeds.end());
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

}  // namespace whirl_twin
