// What the real and the complex Routh test share: roots at zero taken out first, the verdict last.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "analysis/routh.h"
#include "messages/refusal.h"

namespace whirl_twin {

/// The polynomial (highest power first) without leading zeros and without its roots at zero, and
/// how many of those there are. Throws Refusal if all coefficients are zero.
template <typename Coefficient, typename IsZero>
std::pair<std::vector<Coefficient>, int> withoutZeroRoots(
    const std::vector<Coefficient>& coefficients, IsZero is_zero) {
  const auto first = std::find_if_not(coefficients.begin(), coefficients.end(), is_zero);
  if (first == coefficients.end()) {
    throw Refusal("polynomial: expected at least one coefficient that is not zero, found none");
  }
  const auto last = std::find_if_not(coefficients.rbegin(), coefficients.rend(), is_zero).base();
  return {{first, last}, static_cast<int>(coefficients.end() - last)};
}

/// The verdict that follows from the counts.
Verdict verdictOf(const RouthResult& result);

}  // namespace whirl_twin
