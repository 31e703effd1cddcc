// Where the roots of a polynomial lie to the unit circle, exact: z = (1 + w) / (1 - w) takes the
// inside of the circle to the left of the imaginary axis, z = 1 to w = 0 and z = -1 to infinity,
// and Routh's test counts there (E. I. Jury, Theory and Application of the z-Transform Method,
// 1964).
#pragma once

#include <vector>

#include "analysis/exact_number.h"
#include "analysis/routh_result.h"

namespace whirl_twin {

/// p(z) times (1 - w)^n as a polynomial in w of the same length; both highest power first. Roots at
/// z = -1 become leading zeros, those at z = 1 trailing ones.
std::vector<Rational> bilinearTransform(const std::vector<Rational>& polynomial);

/// Roots in z of what bilinearTransform() gave: `left` are inside the unit circle, `imaginary` on
/// it, `right` outside. Refusal and ExactBudgetSpent as routh().
RouthResult routhOfCircle(const std::vector<Rational>& transformed, ExactBudget& budget);

}  // namespace whirl_twin
