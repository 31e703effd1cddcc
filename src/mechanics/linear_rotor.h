// A linear rotor on a shaft whose motion is prescribed: angle theta, speed w, acceleration a.
//
//   M q'' + (C(w) + G(w)) q' + (K(w) + N(w)) q = f(theta, w, a) + f_0
//   f = sum of Re[F_j (w^2 - i a) e^(i m_j theta)]     of what has mass: unbalance, a skewed disc
//     + sum of Re[F_j e^(i m_j theta)]                 of what has none: a residual bow
//
// (w^2 - i a) e^(i theta) is minus the second derivative of e^(i theta): the tangential part of an
// unbalance's force while the speed changes is in it (lecture notes, "whirling of shafts"). The
// gyroscopic moment is that of a driving torque about the disc's own axis: no term in a besides.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// A place along a shaft: x = along_x . q and y = along_y . q [m], across the shaft.
struct Station {
  std::string name;
  double position = 0.0;  ///< [m], along the shaft
  Eigen::VectorXd along_x, along_y;
  /// Its whirl is published besides that of the first station.
  bool published = false;
};

/// A synchronous force, Re[amplitude (w^2 - i a) e^(i harmonic theta)]; without the factor (w^2 - i
/// a) where it is not inertial.
struct ShaftForce {
  Eigen::VectorXcd amplitude;  ///< [kg m] or [kg m^2] inertial, else [N] or [N m]
  int harmonic = 1;
  bool inertial = true;
};

struct LinearRotor {
  std::function<Linearization(double speed)> matrices;  ///< at a constant speed [rad/s]
  bool speed_dependent = false;                         ///< they change with speed
  std::vector<double> knots = {};  ///< [rad/s], ascending: speeds between which they are smooth
  std::vector<ShaftForce> forces = {};
  Eigen::VectorXd load;  ///< f_0 [N] or [N m]
  /// [rad/s], up to which it is that of the machine: a reduced rotor has no more.
  double highest_speed = std::numeric_limits<double>::infinity();

  Eigen::Index dof() const { return load.size(); }
  /// f(theta, w, a), without f_0.
  Eigen::VectorXd shaftForce(double angle, double speed, double acceleration) const;
  /// The complex amplitude F of all forces of harmonic 1 at constant speed: f = Re[F e^(i theta)].
  Eigen::VectorXcd synchronousForce(double speed) const;
};

}  // namespace whirl_twin
