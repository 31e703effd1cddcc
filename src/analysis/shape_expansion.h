// Shape expansion: deflection of a whole rotor from the whirl at some stations, so that a display
// does not need every coordinate.
//
// It is the sum of the static deflection K^-1 f_0 and the steady response at that speed, scaled to
// the measured whirl (fully once that is steady, less where a run-up passes a resonance); the
// residual at the stations is expanded in the slow shapes K^-1 M K^-1 of forces there, nearly the
// lowest modes. At the stations it is exact. For a rotor that its bearings alone do not support, in
// magnetic bearings or films, it consists of those shapes alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/linear_rotor.h"

namespace whirl_twin {

class ShapeExpansion {
 public:
  /// @param seen the stations, in the rotor's coordinates
  ShapeExpansion(LinearRotor rotor, const std::vector<Station>& seen);

  /// The coordinates q. @param angle [rad], of the shaft @param speed [rad/s] @param whirl [m], x
  /// and y of each station in turn
  Eigen::VectorXd at(double angle, double speed, const Eigen::VectorXd& whirl);

 private:
  void prepare(double speed);

  LinearRotor rotor_;
  Eigen::MatrixXd places_;  // [dof x 2 seen]
  bool prepared_ = false;
  double speed_ = 0.0;           // [rad/s], that it is prepared for
  Eigen::VectorXd resting_;      // where the load holds it
  Eigen::VectorXcd steady_;      // amplitude of the steady motion
  Eigen::MatrixXd corrections_;  // q by a displacement of each station
};

}  // namespace whirl_twin
