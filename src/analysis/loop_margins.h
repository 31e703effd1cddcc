// Stability margins of a loop from the open-loop response L at one of its sensors, all other loops
// closed: the peak of the sensitivity |S| = 1 / |1 + L| is the largest amplification of a
// disturbance at that sensor, and 1 / |S| the distance of L from -1.
//
// Zones are those of ISO 14839-3:2006 for rotors in magnetic bearings. Of a strictly proper loop
// that is stable ln|S| has a fixed mean (H. Bode 1945; J. Freudenberg, D. Looze, IEEE Trans.
// Automatic Control 30 (1985) 555; sampled: H. Sung, S. Hara, Int. J. Control 48 (1988) 2429), p
// the poles of the open loop that are unstable:
//   continuous, L falling faster than 1 / w   integral over 0..infinity of ln|S| dw = pi sum Re p
//   sampled                                   integral over 0..pi/T = (pi / T) sum ln|p|
// so that no peak is below 1.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace whirl_twin {

/// The frequencies that a response is evaluated at.
struct LoopSpan {
  /// rad/s: pi / T of a sampled loop.
  double highest = std::numeric_limits<double>::infinity();
  /// 1/s, as far as known: poles of the open and of the closed loop, near which the frequency grid
  /// is refined. At least one is not 0.
  std::vector<std::complex<double>> poles;
  /// rad/s: largest spacing of frequencies; for a long delay, a fraction of 2 pi / delay.
  double spacing = std::numeric_limits<double>::infinity();
};

struct LoopResponse : LoopSpan {
  /// L(w), w >= 0 [rad/s].
  std::function<std::complex<double>(double)> open_loop;
};

/// Of a loop that is opened at several places at once.
struct LoopMatrixResponse : LoopSpan {
  /// The return ratio L(w), [places x places].
  std::function<Eigen::MatrixXcd(double)> open_loop;
};

enum class SensitivityZone : std::uint8_t {
  kA = 0,     ///< peak below 3 (9.5 dB): new machines
  kB,         ///< below 4: fit for long operation
  kC,         ///< up to 5: not for long
  kD,         ///< above: may do damage
  kUnbounded  ///< the loop is not asymptotically stable
};

/// "A" ... "D", "unbounded".
const char* name(SensitivityZone zone);
SensitivityZone zoneOf(double sensitivity_peak);

/// Of a loop that is stable. Nothing that loses stability: infinite, of the gain downwards 0.
struct LoopMargins {
  double sensitivity_peak = 0.0;  ///< [-], max |S|
  double peak_frequency = 0.0;    ///< rad/s
  SensitivityZone zone = SensitivityZone::kUnbounded;
  double gain_margin = 0.0;      ///< [-] > 1: upper limit of the gain factor
  double gain_reduction = 0.0;   ///< [-] < 1: lower limit of the gain factor
  double phase_margin = 0.0;     ///< rad, the smallest change of phase, of either sign
  double phase_crossover = 0.0;  ///< rad/s, its frequency; 0: none
  double delay_margin = 0.0;     ///< s: the smallest ratio of phase margin to frequency
};

/// Throws RunFailure where the peak of |S| is below 1, which no strictly proper loop can be: the
/// response is not that of a loop. Not real-time safe (allocates).
LoopMargins loopMargins(const LoopResponse& response);

/// Margins of a stable loop against the same simultaneous change at all places: gain, phase and
/// delay margin from the eigenvalues of L, for det(I + k e^(-i p) L) = 0 where an eigenvalue is
/// -e^(i p) / k (A. MacFarlane, I. Postlethwaite, Int. J. Control 25 (1977) 81). They can be
/// smaller than any of the individual margins. The peak of the sensitivity is not computed: it is
/// 0. Errors as loopMargins().
LoopMargins simultaneousMargins(const LoopMatrixResponse& response);

/// Integral of ln|S| over 0..highest [rad/s].
double logSensitivityIntegral(const LoopResponse& response);

}  // namespace whirl_twin
