// The roots of a polynomial by simultaneous iteration (Aberth 1973, Ehrlich 1967) in extended
// precision, started on the radii of the Newton polygon (Bini, Numerical Algorithms 13, 1996), so
// that roots of very different size come out alike: no companion matrix, no overflow.
//
// A simple root is found to the rounding of extended precision times its condition; a root of
// multiplicity m keeps about 1/m of the 19 digits. Where the sign of a real part decides, ask
// routh(), which is exact.
#pragma once

#include <complex>
#include <vector>

namespace whirl_twin {

/// All roots with their multiplicity, rightmost first (then by falling imaginary part).
/// `coefficients`: highest power first; leading zeros are dropped. Those of a real polynomial are
/// real or exact conjugate pairs; trailing zero coefficients give exact zeros; a non-zero constant
/// has none; a root too large for a double comes out infinite.
/// Throws Refusal without a non-zero coefficient or with one that is not finite.
/// Not real-time safe (allocates).
std::vector<std::complex<double>> roots(const std::vector<double>& coefficients);
std::vector<std::complex<double>> roots(const std::vector<std::complex<double>>& coefficients);

}  // namespace whirl_twin
