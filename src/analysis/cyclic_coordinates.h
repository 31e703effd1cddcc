// Cyclic coordinates: those that no force and no energy depends on, only their rates (lecture
// notes, "rotating pendulum", "flywheel with sliding masses"; Goldstein, Classical Mechanics, 2.6).
//
// Where nothing drives or damps a cyclic coordinate its momentum p = dL/dv is conserved, and the
// motion of the others, the shape, follows from the reduced (Routh) system at that momentum.
// Otherwise its rate settles to a constant. In both cases the position along it is irrelevant, and
// its zero eigenvalue is irrelevant to stability. The rigid-body modes of a linear system are the
// same along a combination of coordinates.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/stability.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

struct CyclicCoordinates {
  using Places = std::vector<Eigen::Index>;
  /// Columns: the directions that the three lists below count. The unit matrix, but of a linear
  /// system with rigid-body modes these and others that complete them. [n x n]
  Eigen::MatrixXd basis;
  Places shape;      ///< the coordinates that the forces depend on
  Places conserved;  ///< cyclic, with a conserved momentum
  Places driven;     ///< cyclic, but driven or damped

  bool any() const { return !conserved.empty() || !driven.empty(); }
};

/// Evaluated in general position, where a derivative that is exactly zero is zero everywhere;
/// alternating loads are at their mean. speed [rad/s], of the shaft.
CyclicCoordinates cyclicCoordinates(const Dynamics& dynamics, double speed);

/// Those of a linear system, its rigid-body modes: along which K + N is zero (to 1e-12, scaled).
/// Conserved are those that neither damping nor gyroscopic forces act on.
CyclicCoordinates rigidBodyMotions(const Linearization& linearization);

/// The small motion of the shape, then the driven coordinates, at fixed momenta: the conserved
/// coordinates are eliminated (Routh's procedure). Without damping, and without circulatory forces
/// besides, it has none either, exactly. [n - conserved]
Linearization atFixedMomenta(const Linearization& linearization, const CyclicCoordinates& cyclic);

/// Stability of that motion, the zero eigenvalue of each driven coordinate set aside.
Stability reducedStability(const Linearization& linearization, const CyclicCoordinates& cyclic,
                           std::size_t modes = kLowestModes);

/// Eigenvalues at zero of a linear system with these rigid-body motions, a drift's counted twice.
std::size_t zeroEigenvalues(const Linearization& linearization, const CyclicCoordinates& cyclic);

/// Stability of all coordinates of a linear system: reducedStability with the zero eigenvalues of
/// its rigid-body motions, which rounding would scatter to both sides of the axis. A drift grows
/// like t: kRepeatedImaginary.
Stability stabilityWithRigidBodyModes(const Linearization& linearization,
                                      const CyclicCoordinates& cyclic,
                                      std::size_t modes = kLowestModes);

}  // namespace whirl_twin
