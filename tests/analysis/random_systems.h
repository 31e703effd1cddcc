// Random undamped systems, masses joined and held by springs, from a fixed seed.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "algebra/dense.h"

namespace whirl_twin {

struct RandomSystem {
  Eigen::MatrixXd mass, stiffness;
};

/// n coordinates; the mass is full, or diagonal; the condition of both matrices stays below 1e4.
inline RandomSystem randomSystem(int n, std::mt19937& random, bool diagonal_mass = false) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decade(-1.0, 1.0);
  const auto positive = [&](bool diagonal) {
    Eigen::MatrixXd a(n, n);
    Eigen::VectorXd eigenvalue(n);
    for (int i = 0; i < n; ++i) {
      eigenvalue[i] = std::pow(10.0, 2.0 * decade(random));
      for (int j = 0; j < n; ++j) {
        a(i, j) = normal(random);
      }
    }
    if (diagonal) {
      return Eigen::MatrixXd(eigenvalue.asDiagonal());
    }
    const Eigen::MatrixXd q = orthogonalFactor(a);
    const Eigen::MatrixXd full = q * eigenvalue.asDiagonal() * q.transpose();
    return Eigen::MatrixXd(0.5 * (full + full.transpose()));
  };
  const Eigen::MatrixXd mass = positive(diagonal_mass);
  return {mass, positive(false)};
}

inline Eigen::VectorXd randomVector(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) {
    x[i] = normal(random);
  }
  return x;
}

/// n equal masses of 1 kg in a row, bent by V = 1/2 sum of (y_(i-1) - 2 y_i + y_(i+1))^2: a beam
/// without supports, free to heave and to pitch.
inline Eigen::MatrixXd freeBeamStiffness(int n) {
  Eigen::MatrixXd bending = Eigen::MatrixXd::Zero(n - 2, n);
  for (int i = 0; i < n - 2; ++i) {
    bending(i, i) = 1.0;
    bending(i, i + 1) = -2.0;
    bending(i, i + 2) = 1.0;
  }
  return bending.transpose() * bending;
}

}  // namespace whirl_twin
