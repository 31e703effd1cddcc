// Amplification of a linear system by one step of a method, non-rotating or rotating, M q'' + B q'
// + K q = 0 (B = C + G, K with the circulatory part): the largest growth per step, predicted from
// the spectrum of the system and the method's stability function (Hairer & Wanner, Solving Ordinary
// Differential Equations II, IV.2-3), independently of the step's own code; for a multistep method
// from its recurrence, as in `auto`.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <optional>
#include <string>

#include "algebra/dense.h"
#include "integration/stoermer_growth.h"
#include "mechanics/linearization.h"

namespace whirl_twin {

struct FreeDeviation {
  Eigen::MatrixXd by_q, by_v;  ///< q'' = by_q q + by_v q'

  explicit FreeDeviation(const Linearization& l)
      : by_q(-l.mass.inverse() * (l.stiffness + l.circulatory)),
        by_v(-l.mass.inverse() * (l.damping + l.gyroscopic)) {}

  /// y' = A y of y = (q, q').
  Eigen::MatrixXd matrix() const {
    const Eigen::Index n = by_q.rows();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = by_q;
    a.bottomRightCorner(n, n) = by_v;
    return a;
  }
  Eigen::VectorXcd spectrum() const { return eigenvalues(matrix()).values; }
};

inline double spectralRadius(const Eigen::MatrixXd& map) {
  return eigenvalues(map).values.cwiseAbs().maxCoeff();
}

/// R(z) of a Runge-Kutta method; nothing for one that is not named here.
inline std::optional<std::complex<double>> stabilityFunction(const std::string& method,
                                                             std::complex<double> z) {
  using Complex = std::complex<double>;
  if (method == "runge_kutta_4") {
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
  }
  // Gauss: the diagonal Pade approximations of e^z.
  if (method == "implicit_midpoint") {
    return (1.0 + z / 2.0) / (1.0 - z / 2.0);
  }
  if (method == "gauss_legendre_4") {
    return (1.0 + z / 2.0 + z * z / 12.0) / (1.0 - z / 2.0 + z * z / 12.0);
  }
  if (method == "gauss_legendre_6") {
    const Complex even = 1.0 + z * z / 10.0;
    const Complex odd = z / 2.0 + z * z * z / 120.0;
    return (even + odd) / (even - odd);
  }
  if (method == "exponential") {
    return std::exp(z);
  }
  return std::nullopt;
}

/// Largest growth a step of h [s] by the method; nothing where its form is not known here.
inline std::optional<double> growth(const std::string& method, const FreeDeviation& motion,
                                    double h) {
  const Eigen::Index n = motion.by_q.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd map(2 * n, 2 * n);
  if (method == "semi_implicit_euler") {
    const Eigen::MatrixXd v_from_v = one + h * motion.by_v;
    map << one + h * h * motion.by_q, h * v_from_v, h * motion.by_q, v_from_v;
    return spectralRadius(map);
  }
  if (method == "velocity_verlet") {
    // a0 = by_q q + by_v v; q1 = q + h v + h^2/2 a0; a1 = by_q q1 + by_v (v + h a0).
    const Eigen::MatrixXd q_from_q = one + 0.5 * h * h * motion.by_q;
    const Eigen::MatrixXd q_from_v = h * one + 0.5 * h * h * motion.by_v;
    const Eigen::MatrixXd a_from_q = motion.by_q * q_from_q + h * motion.by_v * motion.by_q;
    const Eigen::MatrixXd a_from_v = motion.by_q * q_from_v + motion.by_v * (one + h * motion.by_v);
    map << q_from_q, q_from_v, 0.5 * h * (motion.by_q + a_from_q),
        one + 0.5 * h * (motion.by_v + a_from_v);
    return spectralRadius(map);
  }
  for (const StoermerScheme& scheme : kStoermerSchemes) {
    if (method == scheme.name) {
      return growthInAStep(scheme, motion.by_q, motion.by_v, h);
    }
  }
  double largest = 0.0;
  for (const std::complex<double>& root : motion.spectrum()) {
    const auto factor = stabilityFunction(method, h * root);
    if (!factor) {
      return std::nullopt;
    }
    largest = std::fmax(largest, std::abs(*factor));
  }
  return largest;
}

}  // namespace whirl_twin
