// Bound of the unstable roots of M q'' + (C + G) q' + (K + N) q = 0: with M > 0, K >= 0, C >= 0 and
// a rate nu with nu C + i N >= 0, a root with Re s > 0 has |s| <= nu.
//
// Proof. Of a root s = a + i b with its shape q the forms m, c, k of M, C, K are real, those of G
// and N are i g and i n with g, n real: s^2 m + s (c + i g) + k + i n = 0. The real part of this
// times conj(s) is
//
//   a (|s|^2 m + k) + |s|^2 c + b n = 0.
//
// nu C + i N >= 0 at q and at its conjugate implies |n| <= nu c. So with a > 0 first c > 0 (else n
// = 0, and a |s|^2 m > 0 would contradict the sum of 0), then |s|^2 c <= |b| |n| <= |s| nu c. With
// N = 0 nothing grows, for any gyroscopic forces (Kelvin, Tait and Chetaev). For rotating damping
// alone nu is the speed of the shaft, for cross-coupled stiffness q with damping c it is q / c.
#pragma once

#include <optional>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// nu [1/s], to 1 % from above; 0 where there are no circulatory forces. Nothing where C or K is
/// negative for some motion, or no nu was found: circulatory forces where nothing is damped. All
/// by Cholesky factorizations of matrices scaled to unit diagonal, whose rounding 1e-12 of that
/// diagonal covers.
std::optional<double> unstableRootBound(const BandedLinearization& matrices);

}  // namespace whirl_twin
