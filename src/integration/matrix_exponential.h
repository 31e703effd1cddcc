// The matrix exponential less the identity, e^X - I, and the integral of a quadratic form along it.
//
// Taylor series on X / 2^s with norm below 1/2, then s doublings: e^2X - I = E E + 2 E. Working
// with E = e^X - I keeps the small increments of a small step to full relative accuracy, which a
// propagator that contains the identity loses. (Moler & Van Loan, SIAM Review 45, 2003, method 3.)
// Scale the velocities of a mechanical system by its highest frequency first: the norm, and with it
// the error, is then set by frequency times step. Fixed size: no allocation.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "integration/finite.h"

namespace whirl_twin {

/// Number of halvings that bring the 1-norm of X below 1/2; none where X is not finite: nothing
/// does.
template <int N>
int halvings(const Eigen::Matrix<double, N, N>& X) {
  const double norm = X.cwiseAbs().colwise().sum().maxCoeff();
  return isFinite(norm) && norm > 0.5 ? static_cast<int>(std::ceil(std::log2(norm / 0.5))) : 0;
}

/// The power of two nearest to x > 0, an exact scale; 1 where there is none.
inline double powerOfTwo(double x) {
  return x > 0.0 && std::isfinite(x) ? std::exp2(std::round(std::log2(x))) : 1.0;
}

/// e^X - I.
template <int N>
Eigen::Matrix<double, N, N> exponentialLessIdentity(const Eigen::Matrix<double, N, N>& X) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const int s = halvings<N>(X);
  // 0.5^16/16! < 1e-18: sixteen terms, in powers of x^4 (Paterson & Stockmeyer, SIAM J. Computing
  // 2, 1973), six products in all.
  const Matrix x = std::ldexp(1.0, -s) * X;
  const Matrix x2 = x * x;
  const Matrix x3 = x2 * x;
  const Matrix x4 = x2 * x2;
  Matrix e = Matrix::Zero(x.rows(), x.cols());
  for (const int first : {13, 9, 5, 1}) {
    const auto term = [first](int k) { return 1.0 / std::tgamma(first + k + 1.0); };
    e = (x4 * e).eval() + term(0) * x + term(1) * x2 + term(2) * x3 + term(3) * x4;
  }
  for (int i = 0; i < s; ++i) {
    e = (e * e + 2.0 * e).eval();
  }
  return e;
}

/// From e = e^(A h) - I and w of quadraticIntegral() to those of 2 h.
template <int N>
void twiceAsLong(Eigen::Matrix<double, N, N>& e, Eigen::Matrix<double, N, N>& w) {
  const Eigen::Matrix<double, N, N> we = w * e;
  w = (2.0 * w + we + we.transpose() + e.transpose() * we).eval();
  e = (e * e + 2.0 * e).eval();
}

/// W with  integral over 0..h of y' S y dt = y0' W y0  along y' = A y; S symmetric.
template <int N>
Eigen::Matrix<double, N, N> quadraticIntegral(const Eigen::Matrix<double, N, N>& A,
                                              const Eigen::Matrix<double, N, N>& S, double h) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const int s = halvings<N>(Matrix(2.0 * h * A));
  const double part = std::ldexp(h, -s);
  Matrix term = part * S;
  Matrix w = term;
  for (int k = 2; k <= 18; ++k) {
    term = (part / k * (A.transpose() * term + term * A)).eval();
    w += term;
  }
  Matrix e = exponentialLessIdentity<N>(Matrix(part * A));
  for (int i = 0; i < s; ++i) {
    twiceAsLong<N>(e, w);
  }
  return w;
}

}  // namespace whirl_twin
