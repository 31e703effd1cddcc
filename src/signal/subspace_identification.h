// Covariance-driven stochastic subspace identification of an ambient response: the covariances R_k
// = E[z(t + k T) z(t)^H] of a linear system's motion z, measured at some stations, are sums over
// its modes,
//
//   R_k = sum over m: phi_m g_m^H e^((-s_m + i w_m) k T),   k = 1, 2, ...
//
// and the shift of their block Hankel matrix has the e^(...) as eigenvalues (P. Van Overschee, B.
// De Moor, "Subspace identification for linear systems", 1996, ch. 3; B. Peeters, G. De Roeck,
// Mech. Syst. Signal Process. 13 (1999)). White noise of the probes is in R_0 alone, which is
// excluded; it would bias a fit of the samples themselves. For z = x + i y the sign of w_m is the
// sense of the whirl, so that a forward and a backward mode of equal frequency are distinct.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace whirl_twin {

struct IdentifiedMode {
  double frequency = 0.0;   ///< [rad/s]; positive: whirls from x towards y
  double decay_rate = 0.0;  ///< [1/s]; negative: grows
  double power = 0.0;       ///< [m^2], its part of the mean square of all stations, tr(phi_m g_m^H)
  Eigen::VectorXcd shape;   ///< phi_m [stations], the largest part is 1
};

class SubspaceIdentification {
 public:
  /// Of R_k for k = first_lag, first_lag + 1, ... [stations x stations], an odd number of them,
  /// `spacing` [s] apart. A lag above 1 excludes the first lags, which noise that is not quite
  /// white affects.
  SubspaceIdentification(const std::vector<Eigen::MatrixXcd>& covariance, double spacing,
                         int first_lag = 1);

  /// The modes, strongest first, `order` at most. Frequencies beyond pi/spacing are folded back.
  std::vector<IdentifiedMode> modes(int order) const;

 private:
  double spacing_;
  int first_lag_;
  Eigen::Index stations_;
  Eigen::VectorXcd traces_;   // of R_k
  Eigen::VectorXd singular_;  // of the Hankel matrix
  Eigen::MatrixXcd left_;     // its left singular vectors; none: there is nothing, or no number
};

/// The modes from covariances c_1, c_2, ... of one station, an odd number.
std::vector<IdentifiedMode> identifyModes(const std::vector<std::complex<double>>& covariance,
                                          double spacing, int order);

}  // namespace whirl_twin
