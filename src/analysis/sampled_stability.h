// The verdict on a sampled loop: Routh's test on the exact characteristic polynomial of its
// transition, taken from the unit circle to the imaginary axis, and the eigenvalues beside it.
#pragma once

#include <complex>
#include <vector>

#include "analysis/exact_number.h"
#include "analysis/routh.h"
#include "analysis/sampled_loop.h"

namespace whirl_twin {

// Where the roots of a polynomial lie to the unit circle, exact: z = (1 + w) / (1 - w) takes the
// inside of the circle to the left of the imaginary axis, z = 1 to w = 0 and z = -1 to infinity,
// and Routh's test counts there (E. I. Jury, Theory and Application of the z-Transform Method,
// 1964).

/// p(z) times (1 - w)^n as a polynomial in w of the same length; both highest power first. Roots at
/// z = -1 become leading zeros, those at z = 1 trailing ones.
std::vector<Rational> bilinearTransform(const std::vector<Rational>& polynomial);

/// Roots in z of what bilinearTransform() gave: `left` are inside the unit circle, `imaginary` on
/// it, `right` outside. InputError and ExactBudgetSpent as routh().
RouthResult routhOfCircle(const std::vector<Rational>& transformed, ExactBudget& budget);

struct SampledStability {
  /// Of the loop. kUncertain where rounding of the transition may decide: an eigenvalue that near
  /// to the unit circle which the polynomial does not put exactly on it. Where a direction is
  /// standing and all else dies out: kMarginal.
  Verdict verdict = Verdict::kUncertain;
  /// Of the transition matrix, except for eigenvalues 1 of neutral directions: `left` are inside
  /// the unit circle, `imaginary` on it, `right` outside.
  RouthResult routh;
  /// Beyond kMaxExactStates, or where exact numbers become too long, `routh` counts eigenvalues.
  bool exact = false;
  /// Of a period, by falling modulus; of a loop with long delays those of largest modulus.
  std::vector<std::complex<double>> eigenvalues;
  double spectral_radius = 0.0;  ///< of a period: with one rate of a sample
};

constexpr Eigen::Index kMaxExactStates = 24;

/// Of a loop that is mostly delays the eigenvalues are counted by the argument principle
/// (analysis/delayed_matrix.h). Throws RunFailure for a transition beyond the range of double, or
/// where such a count fails.
SampledStability sampledStability(const SampledLoop& loop);

}  // namespace whirl_twin
