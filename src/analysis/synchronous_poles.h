// The speeds at which the synchronous response of a linear rotor has its poles: the complex w of
//
//   det(K + N - w^2 M + i w (C + G)) = 0.
//
// Each with a positive real part corresponds to a resonance near Re w, with a width of about |Im
// w|; between poles the response is smooth. The matrices may depend on the speed: where they are
// polynomials of degree two in it (gyroscopic moments, rotating damping) the poles are exact, else
// they are computed piecewise from the polynomial through three speeds of each piece.
#pragma once

#include <complex>
#include <vector>

#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// [rad/s], by rising real part, from `low` > 0 to `high`.
std::vector<std::complex<double>> synchronousPoles(const LinearRotor& rotor, double low,
                                                   double high);

/// K + N - w^2 M + i w (C + G) at a speed w [rad/s].
Eigen::MatrixXcd synchronousStiffness(const Linearization& matrices, double speed);

/// Speeds of the peak search between `low` and `high` [rad/s]: `coarse` speeds in equal ratios, and
/// some around each pole in units of its width. Ascending.
std::vector<double> speedsToLookAt(const std::vector<std::complex<double>>& poles, double low,
                                   double high, int coarse);

}  // namespace whirl_twin
