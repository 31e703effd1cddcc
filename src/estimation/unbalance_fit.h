// The unbalance of a rotor while it runs, from what its probes showed over a run-up or at some
// steady speeds: least squares of
//
//   y_c(t) = Re[(sum over planes j: U_j h_cj(t) + r_c) s_c e^(i theta)] + m_c
//
// with the model's whirl h_cj of a unit of unbalance in plane j along the shaft's own motion
// (driven_whirl.h), the run-out r_c of the surface under a probe, its mean m_c, and what its filter
// and delay make of the speed, s_c. The slow roll is in r_c: nothing has to be taken away before.
// At one speed the run-outs are the same as unbalance, and that is told as a direction that the
// record does not tell.
//
// That the model is the machine's is taken for granted: how well it fits is in `noise`.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "estimation/parted_least_squares.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// What forces that turn with the shaft make of a linear rotor while the shaft moves as it was
// measured: run-ups, dwells, whatever. Each force turns as in linear_rotor.h, and
//
//   q = Re(X e^(i theta)),   theta the shaft's angle,
//
// with X followed mode by mode: of a mode of eigenvalue s, xi' = s xi + g w(t) has the solution of
// a shaft whose acceleration is constant from sample to sample. At constant speed X is that of
// synchronous_response.h. Where the matrices change with speed, the modes are those of the middle
// of a band of speeds, their eigenvalues those of the speed.

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

/// Where a mass can sit.
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
  bool run_out_known = false;      ///< then it is no unknown
  std::complex<double> run_out{};  ///< [m], amplitude and angle at which Re(r e^(i theta)) is seen
};

struct ProbeReading {
  std::int64_t index = 0;  ///< rises by one; where some are missing the rotor goes on meanwhile
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft
  double remainder = 0.0;  ///< [rad]
  double speed = 0.0;      ///< [rad/s]
  Eigen::VectorXd values;  ///< [m], of each probe; NaN: it has none
};

struct PhasorEstimate {
  std::complex<double> value;
  double deviation = 0.0;  ///< standard deviation of either part
  bool told = true;        ///< else there is no value
};

/// Unknowns that can change together and leave every reading as it is.
struct UntoldCombination {
  std::vector<std::complex<double>> planes;    ///< [kg m]
  std::vector<std::complex<double>> run_outs;  ///< [m]
};

struct UnbalanceEstimate {
  std::vector<PhasorEstimate> planes;    ///< U_j [kg m], from the shaft's zero
  std::vector<PhasorEstimate> run_outs;  ///< r_c [m]; those that are known as they are known
  std::vector<UntoldCombination> untold;
  std::int64_t samples = 0;
  double lowest_speed = 0.0, highest_speed = 0.0;  ///< [rad/s]
  double duration = 0.0;                           ///< [s]
  double synchronous = 0.0;   ///< [m], root mean square of what the fit explains, without means
  double noise = 0.0;         ///< [m], of what is left
  double beyond_noise = 0.0;  ///< what is left over what the probes' noise makes; 0: not known
};

class UnbalanceFit {
 public:
  /// Throws std::invalid_argument without a plane or a probe.
  UnbalanceFit(const LinearRotor& rotor, const std::vector<BalancingPlane>& planes,
               const std::vector<RotorProbe>& probes);

  void take(const ProbeReading& reading);
  UnbalanceEstimate told() const;

 private:
  bool turnTo(const ProbeReading& reading);
  void add(std::size_t probe, double value, const Eigen::MatrixXcd& amplitudes,
           std::complex<double> turned, double speed);

  std::vector<BalancingPlane> planes_;
  std::vector<RotorProbe> probes_;
  DrivenWhirl whirl_;
  Eigen::VectorXd weight_;  // [1/m], of each probe
  bool noise_known_;
  Eigen::VectorXd offset_;                   // [m], taken away from each probe at once
  std::vector<Eigen::Index> run_out_place_;  // of each probe among the unknowns, or -1
  Eigen::Index first_mean_ = 0;              // unknown, after planes and run-outs
  PartedLeastSquares equations_{0, 0};
  ProbeReading last_;
  bool started_ = false;
  double lowest_speed_ = 0.0, highest_speed_ = 0.0, duration_ = 0.0;
  std::int64_t samples_ = 0;
  double step_ = 0.0;  // [s], from reading to reading
};

}  // namespace whirl_twin
