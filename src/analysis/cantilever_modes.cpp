#include "analysis/cantilever_modes.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// Jacobi polynomials P_0 ... P_(count - 1) of weight (1 - t)^a (1 + t)^b at t, by their three-term
// recurrence, which is stable on [-1, 1].
template <class Real>
Vector<Real> jacobiPolynomials(int count, int a, int b, Real t) {
  Vector<Real> p = Vector<Real>::Ones(count);
  if (count > 1) {
    p[1] = (a - b + (a + b + 2) * t) / 2;
  }
  for (int n = 2; n < count; ++n) {
    const int s = 2 * n + a + b;
    const Real here = (s - 1) * (s * (s - 2) * t + (a * a - b * b));
    const Real before = 2 * (n + a - 1) * (n + b - 1) * s;
    p[n] = (here * p[n - 1] - before * p[n - 2]) / (2 * n * (n + a + b) * (s - 2));
  }
  return p;
}

// P_i(2 xi - 1) of weight xi^4, or their first or second derivatives by xi:
// d/dxi P_n^(a, b) = (n + a + b + 1) P_(n - 1)^(a + 1, b + 1).
template <class Real>
Vector<Real> shiftedJacobi(int count, int derivative, Real xi) {
  Vector<Real> p = Vector<Real>::Zero(count);
  const int rest = count - derivative;
  if (rest > 0) {
    p.tail(rest) = jacobiPolynomials<Real>(rest, derivative, 4 + derivative, 2 * xi - 1);
  }
  for (int i = derivative; i < count; ++i) {
    for (int k = 0; k < derivative; ++k) {
      p[i] *= i + 5 + k;
    }
  }
  return p;
}

// phi_i or a derivative of it by xi, at xi.
template <class Real>
Vector<Real> shapesAt(int count, int derivative, Real xi) {
  const Vector<Real> p = shiftedJacobi(count, 0, xi);
  if (derivative == 0) {
    return xi * xi * p;
  }
  const Vector<Real> p1 = shiftedJacobi(count, 1, xi);
  if (derivative == 1) {
    return 2 * xi * p + xi * xi * p1;
  }
  return 2 * p + 4 * xi * p1 + xi * xi * shiftedJacobi(count, 2, xi);
}

// The integrals are summed in extended precision, so that they come out rounded once.
using Extended = long double;

struct Quadrature {
  Vector<Extended> place, weight;
};

// Gauss-Legendre points and weights on [0, 1] (Golub and Welsch, Mathematics of Computation 23,
// 1969), exact for polynomials to degree 2 points - 1.
Quadrature gaussLegendre(int points) {
  Vector<Extended> off_diagonal(points - 1);
  for (int i = 1; i < points; ++i) {
    off_diagonal[i - 1] = i / std::sqrt(static_cast<Extended>(4 * i * i - 1));
  }
  using Matrix = Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeFromTridiagonal(Vector<Extended>::Zero(points), off_diagonal);
  return {(solver.eigenvalues().array() + 1) / 2,
          solver.eigenvectors().row(0).transpose().array().square()};
}

void requirePositive(double value, const char* what, const char* unit) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InputError(
        fmt::format("cantilever modes: expected a positive {} [{}], found {}", what, unit, value));
  }
}

double placeOnBeam(double x, double length) {
  if (!(x >= 0.0 && x <= length)) {
    throw InputError(fmt::format(
        "cantilever modes: expected x from 0 to the length {} [m], found {}", length, x));
  }
  return x / length;
}

}  // namespace

CantileverModes cantileverModes(double mass_per_length, double length, double bending_stiffness,
                                int count) {
  requirePositive(mass_per_length, "mass per length", "kg/m");
  requirePositive(length, "length", "m");
  requirePositive(bending_stiffness, "bending stiffness", "N m^2");
  if (count < 1 || count > CantileverModes::kMost) {
    throw InputError(fmt::format("cantilever modes: expected 1 to {} modes, found {}",
                                 CantileverModes::kMost, count));
  }
  CantileverModes modes;
  modes.mass_per_length = mass_per_length;
  modes.length = length;
  modes.bending_stiffness = bending_stiffness;
  // int of xi^4 P_i P_j over [0, 1] is 1 / (2 i + 5) for i = j, else 0.
  modes.tip = Eigen::VectorXd::Ones(count);
  // int of xi^4 P_i P_j over [0, 1] is 1 / (2 i + 5) for i = j, else 0.
  modes.mass = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    modes.mass(i, i) = mass_per_length * length / (2 * i + 5);
  }
  Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic> stiffness;
  stiffness.setZero(count, count);
  Vector<Extended> integral = Vector<Extended>::Zero(count);
  // The integrands are polynomials of degree 2 count - 2 and count + 1.
  const Quadrature gauss = gaussLegendre(count + 1);
  for (int point = 0; point <= count; ++point) {
    const Extended xi = gauss.place[point];
    const Vector<Extended> curvature = shapesAt(count, 2, xi);
    stiffness += gauss.weight[point] * curvature * curvature.transpose();
    integral += gauss.weight[point] * shapesAt(count, 0, xi);
  }
  modes.stiffness = bending_stiffness / (length * length * length) * stiffness.cast<double>();
  modes.integral = length * integral.cast<double>();
  return modes;
}

Eigen::VectorXd CantileverModes::shapes(double x) const {
  return shapesAt(count(), 0, placeOnBeam(x, length));
}

Eigen::VectorXd CantileverModes::slopes(double x) const {
  return shapesAt(count(), 1, placeOnBeam(x, length)) / length;
}

Eigen::VectorXd CantileverModes::curvatures(double x) const {
  return shapesAt(count(), 2, placeOnBeam(x, length)) / (length * length);
}

Eigen::VectorXd CantileverModes::monomials(const Eigen::VectorXd& q) const {
  if (q.size() != count()) {
    throw InputError(
        fmt::format("cantilever modes: expected {} coordinates, found {}", count(), q.size()));
  }
  // P_n(2 xi - 1) = (-1)^n (n + 4 over 4) 2F1(-n, n + 5; 5; xi): integers, alternating in sign.
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(count());
  double first = 1.0;
  for (int n = 0; n < count(); ++n) {
    double term = first;
    for (int s = 0; s <= n; ++s) {
      coefficients[s] += term * q[n];
      term *= (s - n) * (n + 5.0 + s) / ((5.0 + s) * (s + 1.0));
    }
    first *= -(n + 5.0) / (n + 1.0);
  }
  return coefficients;
}

}  // namespace whirl_twin
