// The verdict on a sampled loop: Routh's test on the exact characteristic polynomial of its
// transition, taken from the unit circle to the imaginary axis, and the eigenvalues beside it.
#pragma once

#include <complex>
#include <vector>

#include "analysis/routh_result.h"
#include "analysis/sampled_loop.h"

namespace whirl_twin {

struct SampledStability {
  /// Of the loop. kUncertain where rounding of the transition may decide: an eigenvalue that near
  /// to the unit circle which the polynomial does not put exactly on it. Where a direction is
  /// standing and all else dies out: kMarginal.
  Verdict verdict = Verdict::kUncertain;
  /// Of the numbers of the transition as they are, but for eigenvalues 1 of standing directions:
  /// `left` are inside the unit circle, `imaginary` on it, `right` outside.
  RouthResult routh;
  /// Beyond kMostExactStates, or where exact numbers become too long, `routh` counts eigenvalues.
  bool exact = false;
  /// Of a period, by falling modulus; of a loop with long delays those of largest modulus.
  std::vector<std::complex<double>> eigenvalues;
  double spectral_radius = 0.0;  ///< of a period: with one rate of a sample
};

constexpr Eigen::Index kMostExactStates = 24;

/// Of a loop that is mostly delays the eigenvalues are counted by the argument principle
/// (analysis/delayed_matrix.h). Throws RunFailure for a transition beyond the range of double, or
/// where such a count fails.
SampledStability sampledStability(const SampledLoop& loop);

}  // namespace whirl_twin
