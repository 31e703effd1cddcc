// Eigenvalues whose digits the dense solution has lost. Its error is a part of the largest of them:
// beside what is stiff or damps much in a shaft, 1e6 1/s and more, a whirl of 40 rad/s has 9
// digits.
#pragma once

#include <complex>
#include <vector>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// Of M q'' + (C + G) q' + (K + N) q = 0: each of `eigenvalues` [1/s], pairs complete, that may be
/// off by more than some 1e-10 of its modulus is polished by Newton's method on these matrices
/// (polished_root.h); it stays as it is where that leads elsewhere. `norm`: of the state matrix
/// that was solved [1/s].
void refineEigenvalues(const Linearization& linearization, double norm,
                       std::vector<std::complex<double>>& eigenvalues);

}  // namespace whirl_twin
