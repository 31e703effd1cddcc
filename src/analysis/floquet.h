// Floquet stability of a periodic motion. Under periodic excitation the coefficients of the
// linearized motion have a period T, and eigenvalues of their mean do not determine stability: the
// deviations after T are the transition matrix times those before, and decay where its eigenvalues,
// the Floquet multipliers, lie inside the unit circle (G. Floquet, Ann. sci. de l'ENS 12, 1883; A.
// H. Nayfeh & D. T. Mook, Nonlinear Oscillations, 1979, 5.2).
//
// The motion is found by shooting and the transition matrix from the exact variational equations,
// both by the method of order 8 of Dormand and Prince, with as many steps as leave the multipliers
// unchanged when they are doubled.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "analysis/stability.h"
#include "analysis/steady_motion.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Multipliers are not computed for motions of more coordinates.
constexpr int kMaxPeriodicCoordinates = 8;

/// Time dependence of the equations of motion, at a constant speed of the shaft.
struct TimeDependence {
  /// Whether they depend on time, other than by loads that do not affect the linearized motion of a
  /// linear system.
  bool varies = false;
  /// [s], the common period; nothing: unknown, the frequencies have no common period, or the motion
  /// under the mean loads is evaluated.
  std::optional<double> period;
};

/// At a shaft speed [rad/s]. No period: of more than kMaxPeriodicCoordinates coordinates, of
/// equations with cyclic ones, and of a nonlinear rotor that only its unbalance drives: its
/// stability is that of the equilibrium that it whirls around.
TimeDependence timeDependence(const Dynamics& dynamics, double speed);

struct PeriodicMotion {
  double period = 0.0;                            ///< [s]
  Eigen::VectorXd q, v;                           ///< at time 0 and at the angle 0 of the shaft
  std::vector<std::complex<double>> multipliers;  ///< by falling modulus [2 dof]
  double error = 0.0;                             ///< of the multipliers, as steps are doubled
};

/// The motion with this period [s] that Newton's method leads to from a steady motion of the mean
/// loads; nothing where it does not converge.
std::optional<PeriodicMotion> periodicMotionNear(const Dynamics& dynamics, double speed,
                                                 double period, const SteadyMotion& start);

/// Its characteristic exponents log(multiplier) / T [1/s], in the order of the multipliers. Of the
/// frequencies that differ by 2 pi / T each has the one nearest to a natural frequency of
/// `mean_roots` [1/s].
std::vector<std::complex<double>> exponentsOf(const PeriodicMotion& motion,
                                              const std::vector<std::complex<double>>& mean_roots);

/// Whether a deviation grows, beyond the error of the multipliers.
bool grows(const PeriodicMotion& motion);

/// The verdict by the multipliers, and margins from the exponents: without a polynomial. kMarginal:
/// they are simple and on the unit circle, and volume is conserved; kUncertain: nearer to the
/// circle than their error, or on it and not simple.
Stability stabilityOf(const PeriodicMotion& motion,
                      const std::vector<std::complex<double>>& mean_roots);

}  // namespace whirl_twin
