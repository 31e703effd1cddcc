// The independent coordinates of a shaft. Those fixed by a rigid support are eliminated, or move
// with the pedestal below the support. Massless ones on which only springs act are condensed
// statically,
//
//   K_cc q_c + K_ch q_h = 0,   q_c = -K_cc^-1 K_ch q_h   (J. Guyan, AIAA J. 3, 1965),
//
// which is exact there. Damping, speed-dependent bearings, synchronous forces and fluid films give
// such a coordinate its own rate: it is retained, with a mass of kNegligible times the rotor's.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// The mass that a coordinate without any is given where it cannot follow the others. [-]
constexpr double kNegligible = 1.0e-9;

/// The effect of a rigid support on one coordinate.
struct HeldCoordinate {
  static constexpr Eigen::Index kGround = -1;

  Eigen::Index held = 0;
  Eigen::Index to = kGround;  ///< it moves as this one does
};

struct MovingCoordinates {
  std::vector<Eigen::Index> moving;   ///< of all, ascending
  std::vector<Eigen::Index> massive;  ///< of `moving`, those that need a negligible mass
  Eigen::MatrixXd shapes;             ///< q = shapes * q of those that move [n x moving]
};

/// q = shapes * q of those that are not held, ascending. [n x free]
Eigen::MatrixXd supportedShapes(Eigen::Index n, const std::vector<HeldCoordinate>& held);

/// `mass` and `stiffness` [n x n] at rest; `rates`: matrices [n x n] of all other forces; `acted`:
/// the coordinates that other forces act on. Throws InputError where a massless part is
/// unsupported, and where no coordinate can move.
MovingCoordinates movingCoordinates(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                                    const std::vector<Eigen::MatrixXd>& rates,
                                    const std::vector<bool>& acted,
                                    const std::vector<HeldCoordinate>& held);

}  // namespace whirl_twin
