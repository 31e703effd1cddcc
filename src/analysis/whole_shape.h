// Where the whole of a rotor is, from the whirl that is seen at some places along it, so that a
// display need not be told every coordinate.
//
// It is where its bearings hold it under its load, K^-1 f_0, and besides as much of its steady
// motion at that speed as the whirl seen shows (all of it once that is steady, less where a run-up
// passes a resonance); what is then left at the places seen are the slow shapes K^-1 M K^-1 of
// forces there, nearly the lowest modes. At the places seen it is exact. Of a rotor whose bearings
// do not hold it by themselves, in magnets or films, it is those shapes alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/linear_rotor.h"

namespace whirl_twin {

class WholeShape {
 public:
  /// @param seen the places; the rotor's coordinates are theirs
  WholeShape(LinearRotor rotor, const std::vector<Station>& seen);

  /// The coordinates q.
  /// @param angle [rad], of the shaft  @param speed [rad/s]
  /// @param whirl [m], x and y of each place seen, one after the other
  Eigen::VectorXd at(double angle, double speed, const Eigen::VectorXd& whirl);

 private:
  void prepare(double speed);

  LinearRotor rotor_;
  Eigen::MatrixXd places_;  // [dof x 2 seen]
  bool prepared_ = false;
  double speed_ = 0.0;           // [rad/s], that it is prepared for
  Eigen::VectorXd resting_;      // where the load holds it
  Eigen::VectorXcd steady_;      // amplitude of the steady motion
  Eigen::MatrixXd corrections_;  // q by a displacement of each place seen
};

}  // namespace whirl_twin
