// The verdict on a linearized system: Routh's test on the exact characteristic polynomial, and the
// modes from the eigenvalues of the state matrix.
#pragma once

#include <complex>
#include <vector>

#include "analysis/routh.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Number of modes computed for more than kMaxCompleteCoordinates.
constexpr std::size_t kLowestModes = 24;
constexpr std::size_t kAllModes = static_cast<std::size_t>(-1);
constexpr Eigen::Index kMaxCompleteCoordinates = 100;

struct Stability {
  std::vector<std::complex<double>> eigenvalues;  ///< [1/s], by rising |s|, then Im
  /// Number of further eigenvalues, all of larger modulus, not included in the numbers below. The
  /// verdict covers them by a proof (unstable_root_bound.h), or is kUncertain.
  std::size_t omitted = 0;
  /// One entry per vibrating (or overdamped) mode, ascending: |s| [rad/s] and -Re s / |s| [-]. A
  /// pair of real roots s1, s2 < 0 is the mode of frequency sqrt(s1 s2); a saddle has none.
  std::vector<double> natural_frequencies;
  std::vector<double> damping_ratios;
  /// Characteristic, monic, highest power first; empty beyond kMaxExactCoordinates.
  std::vector<double> polynomial;
  RouthResult routh;  ///< a repeated imaginary root with full eigenvectors is marginal
  /// Roots right of the axis by the eigenvalues; routh.right where rounding explains the difference
  /// (rightByEigenvalues), so that another number is a disagreement that nothing explains.
  int right_by_eigenvalues = 0;
  double decay_rate = 0.0;     ///< [1/s], -max Re s
  double damping_ratio = 0.0;  ///< [-], min of -Re s / |s| over roots that are not zero
  double log_decrement = 0.0;  ///< [-], 2 pi zeta / sqrt(1 - zeta^2); NaN when overdamped

  /// Deviations stay bounded.
  bool bounded() const {
    return routh.verdict == Verdict::kAsymptoticallyStable || routh.verdict == Verdict::kMarginal;
  }
};

/// The exact polynomial and Routh's test on it cost seconds beyond this number of coordinates.
/// There, and where exact numbers become too long sooner, the verdict is based on the definiteness
/// of the matrices where that is conclusive (Kelvin, Tait and Chetaev: N = 0, K > 0, and C > 0 or C
/// = 0; cannotGrow), else on the eigenvalues.
constexpr Eigen::Index kMaxExactCoordinates = 8;

/// Without circulatory forces and with C >= 0, K >= 0 (to 1e-12 of a unit diagonal) T + V never
/// rises, whatever gyroscopic forces there are: no root lies right of the axis, and with C = 0 all
/// lie on it, only zeros defective (q^H times the equation: s^2 m + s (c + i g) + k = 0).
bool cannotGrow(const Linearization& linearization);

/// Stability of M q'' + (C + G) q' + (K + N) q = 0. The verdict is kUncertain where the largest
/// real part is below the rounding of the eigenvalues and the polynomial does not make it exactly
/// zero. Throws RunFailure for matrices beyond the range of double, InputError for a singular mass.
Stability stability(const Linearization& linearization);

/// The same without `zeros` roots at 0: those of the last coordinates, whose position is irrelevant
/// (their columns of K + N are exactly zero). For more than kMaxCompleteCoordinates with no zeros
/// the lowest `modes` only, two eigenvalues each, unless they cannot be computed reliably.
Stability stability(const Linearization& linearization, std::size_t zeros,
                    std::size_t modes = kLowestModes);

/// How many of the eigenvalues of this system lie right of the axis, where Routh's test counts
/// `by_routh`. A count of one computation is that of a system next to it, as far off as rounding
/// goes: where the axis is that near (the smallest singular value of A - i w I at an eigenvalue's
/// w), neither can be held against the other, and it is by_routh.
int rightByEigenvalues(const Linearization& linearization, std::size_t zeros,
                       const std::vector<std::complex<double>>& eigenvalues, int by_routh);

/// Eigenvalues only: fast, for searches. [2 dof]
std::vector<std::complex<double>> eigenvalues(const Linearization& linearization);
/// Without the zero of each of the last `zeros` coordinates, as above. [2 dof - zeros]
std::vector<std::complex<double>> eigenvalues(const Linearization& linearization,
                                              std::size_t zeros);

}  // namespace whirl_twin
