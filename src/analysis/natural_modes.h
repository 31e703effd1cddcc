// Natural frequencies and mode shapes of an undamped system, [m] q'' + [k] q = 0:
//   ([k] - p_i^2 [m]) phi_i = 0,   phi_i^T [m] phi_j = 1 for i = j, else 0.
//
// The frequencies are the singular values of L_m^-1 L_k, the Cholesky factors of both matrices: p^2
// is never formed, so that no rounding makes it negative and low modes are as accurate as high
// ones. Rigid-body modes are removed first, as the null space of the stiffness, and have p = 0
// exactly.
#pragma once

#include <Eigen/Core>

#include "analysis/quadratic_form.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Can the accelerations be found at all? They are M^-1 times a force.

/// Smallest over largest eigenvalue of M(q), each coordinate in its natural unit (rad, or the
/// model's natural length): 0 or less where some motion has no inertia. [-]
double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const EvaluationPoint<double>& at);

/// Below this regularity the accelerations may be mostly rounding.
constexpr double kNearlySingularMass = 1.0e-10;

/// Whether some motion has no inertia. Evaluated on M scaled to unit diagonal, so that masses may
/// differ by any ratio.
bool massIsSingular(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at);

/// A radian of each coordinate: of a sliding one, the model's natural length [m].
Eigen::VectorXd naturalUnits(const Dynamics& dynamics);

// Rigid-body modes (lecture notes, "for example a submarine"): motions q that a semidefinite
// stiffness does not resist, [k] q = 0, the modes of zero natural frequency.

/// An orthonormal basis of the motions that the stiffness does not resist [n x r], r = 0 for a
/// definite one. A motion counts as free if the stiffness, scaled to unit diagonal, resists it by
/// less than kZeroEigenvalue. Throws InputError for a matrix that is not symmetric,
/// RunFailure for one that is negative for some motion (a statically unstable position).
Eigen::MatrixXd rigidBodyModes(const Eigen::MatrixXd& stiffness);

struct NaturalModes {
  Eigen::VectorXd frequencies;  ///< p [rad/s], ascending; zero for rigid-body modes [n]
  Eigen::MatrixXd shapes;       ///< columns, mass-normalised [n x n]
  int rigid_body_modes = 0;     ///< how many of the frequencies are zero
};

/// Throws InputError if the mass is not positive definite or a matrix not symmetric, and
/// RunFailure if the stiffness is negative for some motion: then p is imaginary. Which
/// motions count as rigid-body modes: rigidBodyModes().
NaturalModes naturalModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// Throws InputError unless both are of the same size.
void requireSameSize(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

// The assumed modes method for a discrete system (lecture notes): q = [Phi] eta with r assumed
// shapes as columns reduces every matrix to [Phi]^T [.] [Phi] (m_ij = phi_i^T [m] phi_j, k_ij =
// phi_i^T [k] phi_j). The natural frequencies of the reduced system (Rayleigh-Ritz) are not below
// the exact ones of the same order; another shape never raises them; n independent ones give the
// exact ones.

/// The system in r assumed shapes [n x r]; C, G and N are reduced like M and K. Throws
/// InputError for shapes of the wrong size or linearly dependent ones (to 1e-10 of their
/// length).
Linearization reduced(const Linearization& system, const Eigen::MatrixXd& shapes);

struct RitzModes {
  Eigen::MatrixXd mass, stiffness;  ///< reduced [r x r]
  NaturalModes assumed;             ///< of the reduced system; shapes in eta [r x r]
  Eigen::MatrixXd shapes;           ///< the modes in q, mass-normalised [n x r]
};

/// Upper bounds of the r lowest natural frequencies, `assumed.frequencies` [rad/s]. Errors as
/// reduced() and naturalModes().
RitzModes ritzModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                    const Eigen::MatrixXd& shapes);

}  // namespace whirl_twin
