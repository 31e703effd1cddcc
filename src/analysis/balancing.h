// Balancing of a flexible rotor in several planes by influence coefficients (T. P. Goodman, "A
// least-squares method for computing balance corrections", Trans. ASME J. Engineering for Industry
// 86, 1964). Probe readings v are the phasors of the synchronous vibration, amplitude e^(-i lag);
// masses times radii U e^(i angle) are angles from the shaft's mark in the direction of rotation.
// Both may be at several speeds: each probe at each speed is one reading.
//
//   v = v_0 + A u,   A minimizes sum over the runs |v_run - v_0 - A u_run|^2,
//   u minimizes sum w_i |v_0i + (A u)_i|^2.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace whirl_twin {

/// A run with masses in the planes that the initial run does not have.
struct TrialRun {
  Eigen::VectorXcd masses;    ///< u_run [kg m], a plane each; several where earlier ones stay in
  Eigen::VectorXcd readings;  ///< [probes]
};

/// The reflection of a rotor that is the same seen from either end: a mass in plane j does to probe
/// i what the same mass in plane planes[j] does to probe probes[i].
struct Reflection {
  std::vector<Eigen::Index> probes, planes;
};

/// A [readings x planes] and the runs that it was computed from.
struct Influence {
  Eigen::MatrixXcd coefficients;
  std::vector<TrialRun> runs;  ///< empty where A is known from an earlier job
  std::optional<Reflection> reflection;
};

/// By least squares of the runs; with a reflection one run in a plane serves its opposite as well.
/// Throws InputError for no run, readings or masses of different number, and where the masses of
/// the runs do not separate the planes.
Influence influenceOfPlanes(const Eigen::VectorXcd& initial, std::vector<TrialRun> runs,
                            std::optional<Reflection> reflection = std::nullopt);

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

/// Likewise with masses of at most `limits` [kg m], a plane each, infinity for none.
BalanceCorrection balanceWithin(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                                const Eigen::VectorXd& weights, const Eigen::VectorXd& limits);

/// How well a correction is known, where readings have independent errors of one size.
struct CorrectionSpread {
  /// [kg m], standard deviation of either component of each plane's mass times radius.
  Eigen::VectorXd deviation;
  double within95 = 0.0;  ///< deviations that hold 95 %: Student's distribution, or the normal one
};

/// By the propagation of the errors of all runs, those in A among them, to first order. deviation:
/// of either component of a reading, in its unit; 0: as the residual shows, where there are more
/// readings than planes. None where it is not known, or where planes do the same. `correction` is
/// that of balance().
std::optional<CorrectionSpread> correctionSpread(const Influence& influence,
                                                 const Eigen::VectorXd& weights,
                                                 const BalanceCorrection& correction,
                                                 double deviation);

struct PartOfMass {
  double angle = 0.0;        ///< [rad], of the place
  double mass_radius = 0.0;  ///< [kg m]
};
/// The mass on the two places beside its angle (holes of a disc), which together do the same; one
/// place where it is at its angle. `places` [rad], at least three, less than half a turn apart;
/// else InputError.
std::vector<PartOfMass> partsAtPlaces(const std::complex<double>& mass_radius,
                                      std::vector<double> places);

}  // namespace whirl_twin
