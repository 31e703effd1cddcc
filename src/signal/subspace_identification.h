// Covariance-driven stochastic subspace identification of what ambient noise excites: the
// covariances c_k = E[z(t + k T) conj z(t)] of a linear system's motion are sums of its modes,
//
//   c_k = sum over m: p_m e^((-s_m + i w_m) k T),   k = 1, 2, ...
//
// and the shift of their Hankel matrix has the e^(...) as eigenvalues (P. Van Overschee, B. De
// Moor, "Subspace identification for linear systems", 1996, ch. 3; B. Peeters, G. De Roeck, Mech.
// Syst. Signal Process. 13 (1999)). Noise of the probes that is white is in c_0 alone, which is
// left out: that is what spoils a fit of the samples themselves. For z = x + i y the sign of w_m is
// the sense of the whirl.
#pragma once

#include <complex>
#include <vector>

namespace whirl_twin {

struct IdentifiedMode {
  double frequency = 0.0;   ///< [rad/s]; positive: whirls from x towards y
  double decay_rate = 0.0;  ///< [1/s]; negative: grows
  double power = 0.0;       ///< [m^2], its part of the mean square, p_m
};

/// The modes, strongest first, of covariances c_1, c_2, ..., an odd number, `spacing` [s] apart;
/// `order` modes at most. Frequencies beyond pi/spacing are folded back.
std::vector<IdentifiedMode> identifyModes(const std::vector<std::complex<double>>& covariance,
                                          double spacing, int order);

}  // namespace whirl_twin
