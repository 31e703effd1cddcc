// Stability margins of a system from its characteristic polynomial (Den Hartog, Mechanical
// Vibrations; API 684 for the logarithmic decrement):
//   decay rate            sigma* = -max Re s,
//   damping ratio         zeta = min over the roots that are not zero of -Re s / |s|,
//   logarithmic decrement delta = 2 pi zeta / sqrt(1 - zeta^2).
// Negative: unstable by as much. They are as accurate as roots() (polynomial_roots.h); near the
// boundary the verdict is routh()'s.
#pragma once

#include <complex>
#include <vector>

#include "analysis/polynomial_roots.h"

namespace whirl_twin {

/// sigma* [1/s]: every free motion dies at least like exp(-sigma* t). `coefficients`: highest power
/// first, time in seconds. Plus infinity for a constant, which has no motion to decay.
/// Errors as roots().
double decayRate(const std::vector<double>& coefficients);
double decayRate(const std::vector<std::complex<double>>& coefficients);

/// Smallest damping ratio zeta [-], between -1 and 1. Roots at zero (rigid-body rotation) do not
/// count; NaN if there are no others. Errors as roots().
double dampingRatio(const std::vector<double>& coefficients);
double dampingRatio(const std::vector<std::complex<double>>& coefficients);

/// Logarithmic decrement [-] of a free vibration with this damping ratio [-]; NaN if |zeta| >= 1 or
/// NaN, where there is no vibration.
double logDecrement(double damping_ratio);

}  // namespace whirl_twin
