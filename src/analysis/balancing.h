// Balancing of a flexible rotor in several planes by influence coefficients (T. P. Goodman, "A
// least- squares method for computing balance corrections", Trans. ASME J. Engineering for Industry
// 86, 1964). Probe readings v are the phasors of the synchronous vibration, amplitude e^(-i lag);
// masses times radii U e^(i angle) are angles from the shaft's mark in the direction of rotation.
// Both may be at several speeds: each probe at each speed is one reading.
//
//   v = v_0 + A u,   A_ij = (v_i of the run with a trial mass in plane j - v_0i) / u_trial,
//   u minimizes sum w_i |v_0i + (A u)_i|^2.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace whirl_twin {

/// A run with a mass set into one plane, and no other trial mass.
struct TrialRun {
  Eigen::Index plane = 0;
  std::complex<double> mass_radius;  ///< [kg m], at its angle
  Eigen::VectorXcd readings;         ///< [probes]
};

/// A [readings x planes], from at least one run for each plane; of several runs the mean by least
/// squares. Throws InputError for a plane without a run, a mass of zero, or readings of
/// different number.
Eigen::MatrixXcd influenceOfPlanes(const Eigen::VectorXcd& initial,
                                   const std::vector<TrialRun>& runs, Eigen::Index planes);

struct BalanceCorrection {
  Eigen::VectorXcd mass_radius;  ///< u [kg m], a plane each: to be added at its angle
  Eigen::VectorXcd residual;     ///< v predicted, in the unit of the readings
  double rms = 0.0;              ///< of the residual, in that unit
  double condition = 1.0;        ///< of A: large where planes do nearly the same
};

/// The correction with weights w_i >= 0 of the readings; of several the one of least masses. Throws
/// InputError for sizes that do not fit.
BalanceCorrection balance(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                          const Eigen::VectorXd& weights);

/// How well a correction is known, where readings have independent errors of one size.
struct CorrectionSpread {
  /// [kg m], standard deviation of either component of each plane's mass times radius.
  Eigen::VectorXd deviation;
  double within95 = 0.0;  ///< deviations that hold 95 %: Student's distribution, or the normal one
};

/// By the propagation of the errors of all runs, those in A among them, to first order. deviation:
/// of either component of a reading, in its unit; 0: as the residual shows, where there are more
/// readings than planes. None where it is not known, or where planes do the same.
std::optional<CorrectionSpread> correctionSpread(const Eigen::MatrixXcd& influence,
                                                 const std::vector<TrialRun>& runs,
                                                 const Eigen::VectorXd& weights,
                                                 const BalanceCorrection& correction,
                                                 double deviation);

}  // namespace whirl_twin
