// Assumed modes of a uniform cantilever (lecture notes, assumed modes method, "example of a
// continuous system"): y(x, t) = sum of phi_i(x) q_i(t), clamped at x = 0, free at x = L, with
//   m_ij = int m phi_i phi_j dx,   k_ij = int EI phi_i'' phi_j'' dx,   Q_i = sum of F_j phi_i(x_j).
//
// The notes' x^2, x^3 ... span the right space but are nearly parallel: the condition of their mass
// matrix is 3e15 at ten. The shapes here span the same space, so that every Ritz frequency is the
// same, and are orthogonal: phi_i = xi^2 P_i(2 xi - 1), xi = x / L, with the Jacobi polynomials P_i
// of weight xi^4. Each is 1 at the tip, so that q_i is the tip deflection that shape i adds, in m.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// A uniform cantilever in bending, and N assumed modes of it. Vectors are [N], matrices [N x N].
struct CantileverModes {
  static constexpr int kMost = 40;  ///< modes for which the accuracy of the shapes is tested

  double mass_per_length = 0.0;    ///< m [kg/m]
  double length = 0.0;             ///< L [m]
  double bending_stiffness = 0.0;  ///< EI [N m^2]
  Eigen::MatrixXd mass;            ///< [kg], diagonal: m L / (2 i + 5), i from 0
  Eigen::MatrixXd stiffness;       ///< [N/m]
  Eigen::VectorXd tip;             ///< [-], phi_i(L): ones
  Eigen::VectorXd integral;  ///< [m], int phi_i dx: Q_i = -m Y'' integral_i as the clamp moves

  int count() const { return static_cast<int>(tip.size()); }

  /// phi_i [-], phi_i' [1/m] and phi_i'' [1/m^2] of all modes at x [m] from the clamp. A force F
  /// [N] at x loads them with Q = F shapes(x), a moment M [N m] with Q = M slopes(x). Throw
  /// InputError for x off the beam.
  Eigen::VectorXd shapes(double x) const;
  Eigen::VectorXd slopes(double x) const;
  Eigen::VectorXd curvatures(double x) const;

  /// phi_i [-] of one mode, i from 0.
  double shape(int i, double x) const { return shapes(x)[i]; }

  /// c [N], in the unit of q, with sum of phi_i q_i = sum of c_j (x / L)^(j + 2), j from 0: the
  /// coefficients of the notes' shapes times L^(j + 2). Their "L q2 / q1" is c_1 / c_0.
  Eigen::VectorXd monomials(const Eigen::VectorXd& q) const;
};

/// N = `count` assumed modes, 1 to CantileverModes::kMost, of a cantilever of mass per length m
/// [kg/m], length L [m] and bending stiffness EI [N m^2], all positive. Throws
/// InputError otherwise.
CantileverModes cantileverModes(double mass_per_length, double length, double bending_stiffness,
                                int count);

}  // namespace whirl_twin
