// What forces that turn with the shaft make of a linear rotor while the shaft moves as it was
// measured: run-ups, dwells, whatever. Each force turns as in linear_rotor.h, and
//
//   q = Re(X e^(i theta)),   theta the shaft's angle,
//
// with X followed mode by mode: of a mode of eigenvalue s, xi' = s xi + g w(t) has the solution of
// a shaft whose acceleration is constant from sample to sample. At constant speed X is that of
// synchronous_response.h. Where the matrices change with speed, the modes are those of the middle
// of a band of speeds, their eigenvalues those of the speed.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mechanics/linear_rotor.h"

namespace whirl_twin {

inline constexpr std::complex<double> kImaginaryUnit{0.0, 1.0};

class DrivenWhirl {
 public:
  /// Forces of harmonic 1, each for itself.
  DrivenWhirl(const LinearRotor& rotor, const std::vector<ShaftForce>& forces);

  /// As if the shaft had kept this speed [rad/s] for ever.
  void start(double speed);
  /// The next instant: `time` [s] later, the shaft has turned by `turn` [rad], its speed is now
  /// `speed` [rad/s].
  void advance(double time, double turn, double speed);
  /// X [dof x forces].
  Eigen::MatrixXcd amplitudes() const { return shapes_.topRows(rotor_.dof()) * modal_; }

 private:
  void setSpeed(double speed);
  void setModes(double centre);

  LinearRotor rotor_;
  Eigen::MatrixXcd forces_;      // [dof x forces]
  std::vector<bool> inertial_;   // of each
  double half_band_ = 0.0;       // [rad/s]
  double centre_ = 0.0;          // [rad/s], at which the modes are
  double speed_ = 0.0;           // [rad/s]
  Eigen::VectorXcd middle_;      // eigenvalues at the centre [1/s]
  Eigen::VectorXcd slope_;       // and their change with speed
  Eigen::MatrixXcd shapes_;      // [2 dof x modes]
  Eigen::MatrixXcd inverse_;     // of the shapes
  Eigen::MatrixXcd excitation_;  // g [modes x forces]
  Eigen::MatrixXcd modal_;       // xi e^(-i theta) [modes x forces]
};

}  // namespace whirl_twin
