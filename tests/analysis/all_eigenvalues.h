// All eigenvalues of a linearized system by the dense solution in extended precision: the reference
// for faster methods.
#pragma once

#include <complex>
#include <vector>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// [1/s], by rising modulus.
std::vector<std::complex<double>> allEigenvalues(const Linearization& l);

/// The largest difference from the nearest of `all` that no other has taken, of the modulus.
double worstDifference(const std::vector<std::complex<double>>& found,
                       std::vector<std::complex<double>> all);

}  // namespace whirl_twin
