// Unbalance of a rotor in operation, from the readings of its probes over a run-up or at some
// steady speeds: least squares of
//
//   y_c(t) = Re[(sum over planes j: U_j h_cj(t) + r_c) s_c e^(i theta)] + m_c
//
// with the model's whirl h_cj of a unit of unbalance in plane j for the measured motion of the
// shaft (DrivenWhirl), the run-out r_c of the surface under a probe, its mean m_c, and the
// response s_c of its filter and delay at the speed. The slow roll is part of r_c: slow-roll
// compensation is not required. At a single speed run-outs cannot be distinguished from unbalance;
// this is reported as an unidentifiable direction.
//
// The model is assumed to be correct: `noise` shows how well it fits.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "estimation/jackknife_least_squares.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// Response of a linear rotor to synchronous forces (1X) for a measured motion of its shaft, such as
// a run-up or a dwell. Each force rotates as in linear_rotor.h, and
//
//   q = Re(X e^(i theta)),   theta the shaft's angle,
//
// with X integrated mode by mode: for a mode of eigenvalue s, xi' = s xi + g w(t) has the solution
// for a shaft with constant acceleration between samples. At constant speed X is that of
// synchronous_response.h. Where the matrices change with speed, the mode shapes are those of the
// middle of a band of speeds, the eigenvalues those of the speed.

inline constexpr std::complex<double> kImaginaryUnit{0.0, 1.0};

class DrivenWhirl {
 public:
  /// Forces of harmonic 1; each has its own response.
  DrivenWhirl(const LinearRotor& rotor, const std::vector<ShaftForce>& forces);

  /// Steady-state response at a constant speed [rad/s].
  void start(double speed);
  /// The next instant: `time` [s] later, the shaft has turned by `turn` [rad] and has the speed
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
  double centre_ = 0.0;          // [rad/s], speed of the mode shapes
  double speed_ = 0.0;           // [rad/s]
  Eigen::VectorXcd middle_;      // eigenvalues at the centre [1/s]
  Eigen::VectorXcd slope_;       // and their derivative by speed
  Eigen::MatrixXcd shapes_;      // [2 dof x modes]
  Eigen::MatrixXcd inverse_;     // of the shapes
  Eigen::MatrixXcd excitation_;  // g [modes x forces]
  Eigen::MatrixXcd modal_;       // xi e^(-i theta) [modes x forces]
};

/// A plane for correction masses.
struct BalancingPlane {
  std::string name;
  Station station;
};

struct RotorProbe {
  std::string name;
  Eigen::VectorXd along;           ///< displacement = along . q
  double deviation = 0.0;          ///< [m], of its noise; 0: not known
  double delay = 0.0;              ///< [s]
  double bandwidth = 0.0;          ///< [Hz], pole of its filter; 0: none
  bool run_out_known = false;      ///< true: not an unknown
  std::complex<double> run_out{};  ///< [m], amplitude and angle; reading Re(r e^(i theta))
};

struct ProbeReading {
  std::int64_t index = 0;  ///< increases by one; over missing ones the motion is interpolated
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft
  double remainder = 0.0;  ///< [rad]
  double speed = 0.0;      ///< [rad/s]
  Eigen::VectorXd values;  ///< [m], of each probe; NaN: none
};

struct PhasorEstimate {
  std::complex<double> value;
  double deviation = 0.0;    ///< standard deviation of real and imaginary part
  bool identifiable = true;  ///< else there is no value
};

/// A change of unknowns that leaves every reading unchanged.
struct UnidentifiableCombination {
  std::vector<std::complex<double>> planes;    ///< [kg m]
  std::vector<std::complex<double>> run_outs;  ///< [m]
};

struct UnbalanceEstimate {
  std::vector<PhasorEstimate> planes;    ///< U_j [kg m], from the shaft's zero
  std::vector<PhasorEstimate> run_outs;  ///< r_c [m]; known ones unchanged
  std::vector<UnidentifiableCombination> unidentifiable;
  std::int64_t samples = 0;
  double lowest_speed = 0.0, highest_speed = 0.0;  ///< [rad/s]
  double duration = 0.0;                           ///< [s]
  double synchronous = 0.0;   ///< [m], root mean square of the fit, without means
  double noise = 0.0;         ///< [m], of the residuals
  double beyond_noise = 0.0;  ///< residuals over those of the probes' noise; 0: not known
};

class UnbalanceFit {
 public:
  /// Throws std::invalid_argument without a plane or a probe.
  UnbalanceFit(const LinearRotor& rotor, const std::vector<BalancingPlane>& planes,
               const std::vector<RotorProbe>& probes);

  void take(const ProbeReading& reading);
  UnbalanceEstimate estimate() const;

 private:
  bool turnTo(const ProbeReading& reading);
  void add(std::size_t probe, double value, const Eigen::MatrixXcd& amplitudes,
           std::complex<double> turned, double speed);

  std::vector<BalancingPlane> planes_;
  std::vector<RotorProbe> probes_;
  DrivenWhirl whirl_;
  Eigen::VectorXd weight_;  // [1/m], of each probe
  bool noise_known_;
  Eigen::VectorXd offset_;                   // [m], subtracted from each probe at once
  std::vector<Eigen::Index> run_out_place_;  // of each probe, place among the unknowns, or -1
  Eigen::Index first_mean_ = 0;              // place of the first one, after planes and run-outs
  JackknifeLeastSquares equations_{0, 0};
  ProbeReading last_;
  bool started_ = false;
  double lowest_speed_ = 0.0, highest_speed_ = 0.0, duration_ = 0.0;
  std::int64_t samples_ = 0;
  double step_ = 0.0;  // [s], between readings
};

}  // namespace whirl_twin
