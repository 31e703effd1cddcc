// Critical speeds, damping and slow roll of 1X vectors over the speed, as a monitoring system
// exports them: the vectors are those of modes excited by an unbalance, beside the slow roll,
//
//   z(W) = r + sum_k a_k W^2 / (w_k^2 - W^2 + 2 i D_k w_k W),
//
// r and a_k complex. Least squares: r and a_k are linear and eliminated (Golub & Pereyra, "The
// differentiation of pseudo-inverses and nonlinear least squares problems", SIAM J. Numer. Anal. 10
// (1973)), w_k and D_k start from the peaks of the response.
#pragma once

#include <complex>
#include <vector>

namespace whirl_twin {

struct SpeedVector {
  double speed = 0.0;             ///< [rad/s], > 0
  std::complex<double> vector{};  ///< amplitude and minus the phase lag
};

struct FittedResonance {
  double speed = 0.0, speed_deviation = 0.0;  ///< w_k [rad/s], its standard deviation
  double damping_ratio = 0.0, damping_ratio_deviation = 0.0;  ///< D_k
  std::complex<double> residue{};  ///< a_k; the vector far above the critical speed is -a_k
  double amplification_factor() const { return 0.5 / damping_ratio; }
};

struct ResonanceFit {
  std::complex<double> slow_roll{};
  double slow_roll_deviation = 0.0;         ///< of each component
  std::vector<FittedResonance> resonances;  ///< by speed
  double rms = 0.0;                         ///< of the residual vectors
  std::complex<double> at(double speed) const;
};

/// At least eight vectors, by speed. No resonances where no peak is within the speeds; then the
/// slow roll is the mean.
ResonanceFit fitResonances(const std::vector<SpeedVector>& vectors);

}  // namespace whirl_twin
